"""Simulated modes: with typical materials before the fit, with the identified ones after it."""

from __future__ import annotations

import io
import json
from pathlib import Path

import pandas as pd
import pytest

from cheap_study import append, coarse, edit, write_study
from command import statorhom
from statorhom.identify.chain import chain
from statorhom.results.files import read_results
from statorhom.results.shape_file import read_shape_file
from statorhom.simulate import simulate_study
from statorhom.study.study import load_study

COLUMNS = ["mode", "frequency_hz", "order", "axial", "stage", "test"]


@pytest.fixture(autouse=True)
def quick(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("statorhom.simulate.Settings", coarse)


def test_writes_a_table_of_all_steps_and_their_shapes(tmp_path: Path) -> None:
    path, table = simulate_study(write_study(tmp_path), None, None)
    assert path == tmp_path / "ring-results" / "modes.csv"
    written = pd.read_csv(path)
    assert list(written.columns) == COLUMNS
    assert list(written["stage"].unique()) == ["stack", "framed"]
    assert list(written["test"].unique()) == ["stack-free", "framed-free"]
    assert (written["frequency_hz"] > 0).all()
    for _, modes in written.groupby("stage"):
        assert modes["frequency_hz"].is_monotonic_increasing
        assert list(modes["mode"]) == list(range(1, len(modes) + 1))
        assert {(2, 0), (2, 1)} <= set(zip(modes["order"], modes["axial"], strict=True))
    pd.testing.assert_frame_equal(written, table, check_dtype=False)
    for name in ("simulated-1-stack.npz", "simulated-2-framed.npz"):
        assert read_shape_file(tmp_path / "ring-results" / "shapes" / name).modes


def test_one_step_alone(tmp_path: Path) -> None:
    study = write_study(tmp_path)
    _, both = simulate_study(study, None, tmp_path / "both")
    _, framed = simulate_study(study, "framed", tmp_path / "framed")
    expected = both[both["stage"] == "framed"].reset_index(drop=True)
    pd.testing.assert_frame_equal(framed, expected)


def test_identified_materials_are_taken_where_there_are_some(tmp_path: Path) -> None:
    study, out = write_study(tmp_path), tmp_path / "out"
    _, typical = simulate_study(study, "stack", out)
    chain(load_study(study), out, coarse()).run(0)
    _, identified = simulate_study(study, "stack", out)
    stack = read_results(out).stages[0]
    modulus = stack.regions["lamination"].engineering["E_pa"].value
    ratio = identified["frequency_hz"] / typical["frequency_hz"]
    # nu and mass are the same: every frequency has the same ratio
    assert ratio.max() - ratio.min() < 1e-4
    assert 0.8 < ratio[0] < 1.2 and ratio[0] != 1.0
    assert 150e9 < modulus < 205e9
    fitted = stack.modes[0]
    first = identified.iloc[0]
    assert (first["order"], first["axial"]) == (fitted.order, fitted.axial) == (2, 0)
    assert fitted.simulated_hz is not None and fitted.model_sd_hz is not None
    # both are extrapolated to a converged mesh; the fit also moves within the model's own uncertainty
    assert abs(first["frequency_hz"] - fitted.simulated_hz) < 2 * fitted.model_sd_hz


def test_recordings_need_not_be_read(tmp_path: Path) -> None:
    """A test is simulated to see what to measure, before anything can be fitted."""
    study = write_study(tmp_path)
    edit(study, 'modal_table = "framed.csv"', 'frf = "framed.uff"')
    append(tmp_path / "framed.uff", "    -1\n")
    _, table = simulate_study(study, "framed", None)
    assert set(table["test"]) == {"framed-free"}


def test_json_is_the_whole_of_standard_output(tmp_path: Path) -> None:
    outcome = statorhom("simulate", write_study(tmp_path), "--stage", "stack", "--json")
    assert outcome.code == 0 and outcome.stderr == ""
    rows = json.loads(outcome.stdout)
    assert [list(row) for row in rows] == [COLUMNS] * len(rows)
    written = pd.read_csv(tmp_path / "ring-results" / "modes.csv")
    pd.testing.assert_frame_equal(pd.read_json(io.StringIO(outcome.stdout)), written, check_dtype=False)


def test_the_table_is_printed(tmp_path: Path) -> None:
    outcome = statorhom("simulate", write_study(tmp_path), "--stage", "stack")
    assert outcome.code == 0
    assert outcome.stderr == f"wrote {tmp_path / 'ring-results' / 'modes.csv'}\n"
    lines = outcome.stdout.splitlines()
    assert lines[0].split() == COLUMNS
    assert len(lines) == 1 + len(pd.read_csv(tmp_path / "ring-results" / "modes.csv"))
