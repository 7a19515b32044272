"""`statorhom modes`: what it writes and refuses."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest
from PIL import Image

from cheap_study import edit, write_study
from command import statorhom
from ring_recording import write_recording
from statorhom.recordings.read import read_recording
from statorhom.study.modal_table import read_modal_table


@pytest.fixture(scope="module")
def done(tmp_path_factory: pytest.TempPathFactory) -> Path:
    root = tmp_path_factory.mktemp("modes")
    outcome = statorhom("modes", write_recording(root / "ring.uff"), "--out", root / "out")
    assert outcome.code == 0, outcome.stderr
    (root / "said.txt").write_text(outcome.stdout, encoding="utf-8")
    return root


def test_the_modes_are_printed(done: Path) -> None:
    said = (done / "said.txt").read_text(encoding="utf-8")
    assert ("(2, 0)" in said and "(2, 1)" in said and "3089.99" in said) or "3090.0" in said


def test_table_and_shapes_are_written(done: Path) -> None:
    table = read_modal_table(done / "out" / "modes.csv")
    assert [(m.order, m.axial) for m in table.modes] == [(2, 0), (2, 1)]
    shapes = read_recording([done / "out" / "shapes.uff"]).shapes
    assert [len(shape.nodes) for shape in shapes] == [36, 36]
    assert shapes[0].frequency_hz == pytest.approx(3090.0, rel=1e-4)


def test_plots_are_pictures_and_shapes_move(done: Path) -> None:
    plots = done / "out" / "plots"
    names = {"frf-01.png", "stabilization.png", "cmif.png", "circle-01.png", "orders-01.png", "shape-01.gif"}
    assert names <= {path.name for path in plots.iterdir()}
    for name in names:
        with Image.open(plots / name) as picture:
            assert min(picture.size) > 300
            assert getattr(picture, "n_frames", 1) > 10 or not name.endswith(".gif")


def test_json_lists_the_modes(tmp_path: Path) -> None:
    outcome = statorhom("modes", write_recording(tmp_path / "ring.uff"), "--out", tmp_path / "o", "--json")
    assert [row["order"] for row in json.loads(outcome.stdout)] == [2, 2]


def test_a_study_without_these_files_is_refused(tmp_path: Path) -> None:
    recording = write_recording(tmp_path / "ring.uff")
    outcome = statorhom("modes", recording, "--study", write_study(tmp_path), "--out", tmp_path / "o")
    assert outcome.code == 2
    assert "study.toml: no test has" in outcome.stderr and len(outcome.stderr.splitlines()) == 1
    assert not (tmp_path / "o").exists()


def test_a_file_that_is_no_recording_is_refused(tmp_path: Path) -> None:
    (tmp_path / "ring.uff").write_text("    -1\n", encoding="utf-8")
    outcome = statorhom("modes", tmp_path / "ring.uff", "--out", tmp_path / "o")
    assert outcome.code == 2
    assert "ring.uff" in outcome.stderr and len(outcome.stderr.splitlines()) == 1


def test_remarks_of_recordings_reach_the_report(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from cheap_study import coarse
    from statorhom import Study
    from statorhom.identify.stages import recorded_tests

    extracted = recorded_tests.measured_modes
    monkeypatch.setattr("statorhom.api.Settings", coarse)
    monkeypatch.setattr(
        recorded_tests,
        "measured_modes",
        lambda *arguments: replace(extracted(*arguments), remarks=("hit 3: the force overloads",)),
    )
    study = write_study(tmp_path / "study")
    write_recording(tmp_path / "study" / "stack.uff")
    edit(study, 'modal_table = "stack.csv"', 'frf = "stack.uff"')
    for folder in ("out", "out"):  # the second time from what was kept
        stage = Study.load(study).fit(tmp_path / folder, stage="stack").stages[0]
        assert "test 'stack-free': hit 3: the force overloads" in stage.warnings
        (tmp_path / folder / "results.json").unlink()


def test_a_study_fits_its_recordings(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The recording of the stack instead of its table: same constants, and the shapes are compared."""
    from cheap_study import coarse
    from statorhom import Study

    monkeypatch.setattr("statorhom.api.Settings", coarse)
    study = write_study(tmp_path / "study")
    by_table = Study.load(study).fit(tmp_path / "table", stage="stack").stages[0]
    write_recording(tmp_path / "study" / "stack.uff")
    edit(study, 'modal_table = "stack.csv"', 'frf = "stack.uff"')
    by_recording = Study.load(study).fit(tmp_path / "recording", stage="stack").stages[0]
    moduli = [s.regions["lamination"].engineering["E_pa"].value for s in (by_table, by_recording)]
    assert moduli[1] == pytest.approx(moduli[0], rel=2e-3)
    fitted = [mode for mode in by_recording.modes if mode.role == "fitted"]
    assert [(m.order, m.axial) for m in fitted] == [(2, 0), (2, 1)]
    assert all(m.mac is not None and m.mac > 0.9 for m in fitted)
    kept = tmp_path / "recording" / "recordings" / "stack-free.csv"
    before = kept.stat().st_mtime_ns
    Study.load(study).fit(tmp_path / "recording", stage="stack")
    assert kept.stat().st_mtime_ns == before  # extracted once
    write_recording(tmp_path / "study" / "stack.uff", ((2, 0, 3000.0, 0.004, 0.3),))
    Study.load(study).fit(tmp_path / "recording", stage="stack")
    assert len(read_modal_table(kept).modes) == 1  # another file, other modes
