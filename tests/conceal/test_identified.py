"""Materials that were identified become the true ones."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from concealed_rings import COARSE, write_ring
from statorhom.conceal.conceal_study import Wish, conceal_study
from statorhom.conceal.identified import identified_materials
from statorhom.errors import ResultsError

CONSTANTS = {"E_p_pa": 1.9e11, "E_z_pa": 8e10, "nu_p": 0.29, "nu_pz": 0.26, "G_rz_pa": 3e10}


def write_results(folder: Path, **changes: object) -> Path:
    def figure(value: float) -> dict[str, object]:
        return {"value": value, "ci90": [value, value], "status": "identified"}

    region = {
        "volume_m3": 3e-4,
        "density_kg_m3": 7700.0,
        "symmetry": "transversely_isotropic",
        "loss_factor": figure(0.007),
        "engineering": {name: figure(value) for name, value in CONSTANTS.items()},
    }
    weights = {"mass_kg": 2.3, "mass_sd_kg": 0.002, "added_mass_kg": 2.3}
    stage = {
        "name": "stack",
        "kind": "stack",
        **weights,
        "regions": {"lamination": region | changes},
        "modes": [],
    }
    folder.mkdir()
    text = json.dumps({"schema": 1, "study": "ring", "seed": 1, "stages": [stage]})
    (folder / "results.json").write_text(text, encoding="utf-8")
    return folder


def test_they_are_taken(tmp_path: Path) -> None:
    results = write_results(tmp_path / "results")
    template = write_ring(tmp_path / "template")
    _, case = conceal_study(template, [Wish("none")], tmp_path / "out", materials=results, density=COARSE)
    found = case.stages[0].materials["lamination"]
    assert (found.constants, found.density, found.loss_factor) == (CONSTANTS, 7700.0, 0.007)


def test_what_is_not_known_completely_is_not_taken(tmp_path: Path) -> None:
    assert identified_materials(write_results(tmp_path / "results", loss_factor=None)) == {}


def test_a_folder_without_results_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ResultsError, match=r"results\.json"):
        identified_materials(tmp_path)
