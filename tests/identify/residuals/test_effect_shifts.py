"""Declared effects in simulated and fitted frequencies."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from cheap_study import append, coarse, edit, write_study
from statorhom.errors import IdentificationError
from statorhom.identify.chain import chain
from statorhom.identify.residuals.doublet_lines import line_shifts
from statorhom.model.broken.named_response import Response
from statorhom.results.schema import StageResult
from statorhom.simulate import simulate_study
from statorhom.study.study import load_study

LUMP = """
[[stages.effects]]
effect = "attached_mass"
mass_kg = 0.05
angle_deg = 100.0
z_mm = 20.0
"""
WARM = '\n[[stages.effects]]\neffect = "temperature_shift"\ntest = "framed-free"\ntemperature_k = 40.0\n'


@pytest.fixture(autouse=True)
def quick(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("statorhom.simulate.Settings", coarse)


def stack_alone(folder: Path, effect: str = "") -> Path:
    """The cheap study's first step, with an effect."""
    path = write_study(folder)
    text = path.read_text(encoding="utf-8").split('\n[[stages]]\nname = "framed"')[0]
    path.write_text(text + effect, encoding="utf-8")
    return path


def modes(study: Path, stage: str) -> pd.DataFrame:
    """Simulated modes."""
    return simulate_study(study, stage, study.parent / "simulated")[1]


def fitted(study: Path) -> StageResult:
    return chain(load_study(study), study.parent / "out", coarse()).run().stages[0]


def test_a_lump_splits_doublets_and_a_warm_test_lowers_all(tmp_path: Path) -> None:
    plain, lumped = (modes(stack_alone(tmp_path / str(i), e), "stack") for i, e in enumerate(("", LUMP)))
    pair = lumped[(lumped["order"] == 2) & (lumped["axial"] == 0)]["frequency_hz"].to_numpy()
    alone = plain[(plain["order"] == 2) & (plain["axial"] == 0)]["frequency_hz"].to_numpy()
    # m φ²/2 of the lower line, with φ² about 2/M x 2 r²/(r² + 1) for a thin ring
    assert len(alone) == 1 and len(pair) == 2
    assert np.log(pair[0] / alone[0]) == pytest.approx(-0.5 * 0.05 * 1.6 / 2.313, rel=0.5)
    assert abs(np.log(pair[1] / alone[0])) < 0.5 * abs(np.log(pair[0] / alone[0]))

    warm, cold = write_study(tmp_path / "warm"), write_study(tmp_path / "cold")
    append(warm, WARM)
    ratio = modes(warm, "framed")["frequency_hz"] / modes(cold, "framed")["frequency_hz"]
    assert ratio.to_numpy() == pytest.approx(np.sqrt(1 - 3e-4 * 40.0), abs=2e-5)


def test_constants_are_fitted_to_frequencies_with_the_effect(tmp_path: Path) -> None:
    """What `simulate` says of a lumped ring is fitted by its constants with the lump, and by others without."""
    study = stack_alone(tmp_path / "with", LUMP)
    table = modes(study, "stack")
    rows = table[(table["order"] == 2) & table["axial"].isin([0, 1])]
    lines = ["frequency_hz,frequency_sd_hz,order,axial"]
    lines += [f"{m.frequency_hz},1.0,{m.order},{m.axial}" for m in rows.itertuples()]
    assert len(lines) == 5
    found = []
    for folder, effect in (("with", LUMP), ("without", "")):
        path = stack_alone(tmp_path / folder, effect)
        (path.parent / "stack.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
        found.append(fitted(path))
    right, wrong = (stage.regions["lamination"].engineering["E_pa"].value for stage in found)
    assert found[0].fit is not None and found[1].fit is not None
    # meshes of this test are so coarse that two of them and three extrapolate to 0.3 % off
    assert found[0].fit.rms_percent < 0.4 < 1.0 < found[1].fit.rms_percent
    # a lump of 2 % lowers the frequencies by about 0.9 % in the mean, and the modulus by twice that
    assert np.log(right / wrong) == pytest.approx(0.018, rel=0.5)
    assert any("attached_mass" in line for line in found[0].assumptions)


def test_what_the_chain_cannot_contain_is_refused_in_one_line(tmp_path: Path) -> None:
    study = write_study(tmp_path / "two")
    append(study, '\n[[stages.tests]]\nname = "again"\nsupport = "free"\nmodal_table = "framed.csv"\n')
    append(study, WARM)
    with pytest.raises(IdentificationError, match='give one of them role = "predict"'):
        chain(load_study(study), tmp_path / "out", coarse()).check()
    edit(study, 'name = "again"', 'name = "again"\nrole = "predict"')
    chain(load_study(study), tmp_path / "out", coarse()).check()


def test_lines_of_a_doublet_lie_on_both_sides_of_its_middle() -> None:
    key, other = (2, 0, 0), (3, 0, 0)
    effects = {key: Response(0.0, 0.04j)}
    middle = {key: 1000.0, other: 3000.0}
    assert line_shifts([1012.0, 990.0, 3000.0], [key, key, other], effects, middle) == [0.01, -0.01, 0.0]
    assert line_shifts([1004.0], [key], effects, middle) == [0.01]
    assert line_shifts([1004.0], [None], effects, middle) == [0.0]
