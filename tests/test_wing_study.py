"""A wing from its files to its modes and materials."""

from __future__ import annotations

from pathlib import Path

import pytest

from command import statorhom
from coupon_study import table_text
from statorhom.api import Study
from statorhom.identify.chain import chain
from statorhom.identify.stages.settings import Settings
from statorhom.report import write_report
from statorhom.simulate import simulate_study
from statorhom.study.study import load_study
from wing_study import CLOTH, FOAM, SMALL_STUDY, SMALL_WING, wing_frequencies, write_wing


def test_a_wing_is_simulated_and_its_modes_have_names(tmp_path: Path) -> None:
    file, table = simulate_study(write_wing(tmp_path, table="150\n190\n"), None, tmp_path / "out")
    assert file.exists()
    assert table["order"].isna().all() and table["frequency_hz"].is_monotonic_increasing
    assert table["name"][0] == "symmetric bending (2, 0)"


def test_the_volumes_of_a_wing_are_its_materials(tmp_path: Path) -> None:
    volumes = Study.load(write_wing(tmp_path)).volumes("wing")
    assert set(volumes) == {"cloth", "foam"} and min(volumes.values()) > 0.0


@pytest.mark.slow
@pytest.mark.parametrize("method", ["annealing", "response_surface"])
def test_a_wing_with_lumps_is_identified_and_reported(tmp_path: Path, method: str) -> None:
    study = SMALL_STUDY.replace("chains = 1\n", f'chains = 1\nmethod = "{method}"\n')
    path = write_wing(tmp_path, study=study)
    frequencies = wing_frequencies(path, {"cloth": CLOTH, "foam": FOAM}, 400.0, 1.0)
    (tmp_path / "free.csv").write_text(table_text(frequencies, 1e-4, 1), encoding="utf-8")
    results = chain(load_study(path), tmp_path / "out", Settings(refinements=(1.0,))).run()
    stage = results.stages[0]
    cloth = stage.regions["cloth"].engineering
    assert cloth["E_1_pa"].value == pytest.approx(47.126e9, rel=0.02)
    assert cloth["G_12_pa"].value == pytest.approx(3.927e9, rel=0.02)
    assert set(stage.regions) == {"cloth", "foam"}
    assert results.geometry["kind"] == "wing"
    assert any((m.kind or "").startswith("symmetric bending") for m in stage.modes)
    write_report(tmp_path / "out")
    page = (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    assert "Every material of the wing" in page and "symmetric bending (2, 0)" in page


@pytest.mark.slow
def test_heavier_fins_at_the_tips_lower_the_bending(tmp_path: Path) -> None:
    heavy = SMALL_WING.replace("mass_g = 15.0", "mass_g = 45.0")
    found = {}
    for name, text in (("light", SMALL_WING), ("heavy", heavy)):
        (tmp_path / name).mkdir()
        mass = 1.9 + (0.06 if name == "heavy" else 0.0)
        study = SMALL_STUDY.replace("mass_kg = 1.9", f"mass_kg = {mass}")
        path = write_wing(tmp_path / name, geometry=text, study=study)
        found[name] = wing_frequencies(path, {"cloth": CLOTH, "foam": FOAM}, 250.0, 1.0)
    assert found["heavy"][0] < 0.98 * found["light"][0]


def test_an_unknown_stage_of_a_wing_is_one_line(tmp_path: Path) -> None:
    outcome = statorhom("simulate", write_wing(tmp_path), "--stage", "skin", "--out", tmp_path / "out")
    assert outcome.code == 2 and "no stage 'skin'; choose one of wing" in outcome.stderr
