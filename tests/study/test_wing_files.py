"""Geometry and study files of wings: every fault is one line with file, key and remedy."""

from __future__ import annotations

from pathlib import Path

import pytest

from refused import refused_study
from statorhom.study.object_file import read_object
from statorhom.study.study import load_study
from statorhom.study.wing_file import WingFile
from wing_study import SMALL_STUDY, SMALL_WING, write_wing

EXAMPLE = Path(__file__).resolve().parents[2] / "geometries" / "flying-wing-1900mm.toml"


def test_the_example_is_a_wing_of_four_materials() -> None:
    file = read_object(EXAMPLE)
    assert isinstance(file, WingFile)
    assert file.wing.materials == ("cbx90", "herex", "interglass", "cage")


def test_the_regions_of_a_wing_are_its_materials(tmp_path: Path) -> None:
    files = load_study(write_wing(tmp_path))
    assert files.study.regions(0) == ("cloth", "foam")
    assert files.study.symmetry(0, "cloth") == "orthotropic"


@pytest.mark.parametrize(
    ("old", "new", "fragments"),
    [
        ("angle_deg = 45.0", "angle_deg = 145.0", ["wing.plies[#1].angle_deg", "at most 90", "145"]),
        ("angle_deg = 45.0", "angle_deg = -91.0", ["wing.plies[#1].angle_deg", "at least -90"]),
        ("thickness_mm = 2.5", "thickness_mm = 0.0", ["wing.plies[#1].thickness_mm", "greater than 0"]),
        ("mass_g = 15.0", "mass_g = 0.0", ["wing.lumps[fin].mass_g", "greater than 0"]),
        ("[30.0, 70.0]", "[30.0, 170.0]", ["wing.spars_percent", "less than 100"]),
        ("[30.0, 70.0]", "[30.0]", ["wing.spars_percent", "add what is missing"]),
        ("thickness_mm = 2.5", "thicknes_mm = 2.5", ['unknown key "thicknes_mm"', '"thickness_mm"']),
        ('"cloth"', '"the cloth"', ["wing.plies[#1].material", "the cloth"]),
        ('"cloth"', '"lumps"', ["wing.plies[#1].material", "another name"]),
        (
            "foam = 80.0",
            "foma = 80.0",
            ['density_kg_m3.foma: nothing is made of "foma"', 'did you mean "foam"?'],
        ),
        ("foam = 80.0", "", ["those of cloth, foam are missing", "add all but one"]),
        ("foam = 80.0", "foam = 0.0", ["density_kg_m3.foam", "greater than 0"]),
    ],
)
def test_faults_of_the_geometry(tmp_path: Path, old: str, new: str, fragments: list[str]) -> None:
    assert old in SMALL_WING
    refused_study(write_wing(tmp_path, geometry=SMALL_WING.replace(old, new, 1)), *fragments)


@pytest.mark.parametrize(
    ("old", "new", "fragments"),
    [
        ('foam = "isotropic"', 'foam = "isotrop"', ["model.wing.foam", "isotrop", "did you mean"]),
        ("[stages.model.wing]", '[stages.model]\nplate = "isotropic"\n[stages.model.wing]', ["model.plate"]),
        ("fixed]\ncloth", "fixed]\nwing = { E_pa = 1e9 }\ncloth", ['no region "wing" is declared']),
        ("nu_12 = 0.04", "nu_12 = 1.4", ["fixed.cloth.nu_12", "no Poisson ratio"]),
    ],
)
def test_faults_of_the_study(tmp_path: Path, old: str, new: str, fragments: list[str]) -> None:
    assert old in SMALL_STUDY
    refused_study(write_wing(tmp_path, study=SMALL_STUDY.replace(old, new, 1)), *fragments)


@pytest.mark.parametrize(
    ("declared", "fragments"),
    [
        ("", ["stages[wing].model.wing.foam: is missing", "object.toml has it"]),
        ('foan = "isotropic"\n', ["model.wing.foan", "wing of cloth, foam", '"foam"?']),
    ],
)
def test_every_material_needs_a_symmetry(tmp_path: Path, declared: str, fragments: list[str]) -> None:
    text = SMALL_STUDY.replace("foam = { E_pa = 60e6, nu = 0.3 }\n", "")
    refused_study(write_wing(tmp_path, study=text.replace('foam = "isotropic"\n', declared)), *fragments)
