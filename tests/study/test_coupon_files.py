"""Geometry and study files of coupons: every fault is one line with file, key and remedy."""

from __future__ import annotations

from pathlib import Path

import pytest

from coupon_study import BEAM, PLATE, TUBE, study_text, write_study
from refused import refused_study
from statorhom.study.coupon_file import BeamFile, PlateFile, TubeFile
from statorhom.study.object_file import read_object

TABLE = 'modal_table = "free.csv"'


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "free.csv").write_text("frequency_hz\n200.0\n300.0\n", encoding="utf-8")
    return tmp_path


@pytest.mark.parametrize(("text", "kind"), [(PLATE, PlateFile), (BEAM, BeamFile), (TUBE, TubeFile)])
def test_each_kind_has_a_file_of_its_own(tmp_path: Path, text: str, kind: type) -> None:
    path = tmp_path / "object.toml"
    path.write_text(text, encoding="utf-8")
    assert isinstance(read_object(path), kind)


@pytest.mark.parametrize(
    ("geometry", "fragments"),
    [
        (PLATE.replace("thickness_mm = 4.0", "thickness_mm = 0.0"), ["plate.thickness_mm", "greater than 0"]),
        (PLATE.replace("width_mm", "widht_mm"), ['unknown key "widht_mm"', 'did you mean "width_mm"?']),
        (PLATE.replace("[plate]", "[beam]"), ['unknown key "beam"']),
        (PLATE.replace('kind = "plate"', 'kind = "plates"'), ['kind: "plates"', 'did you mean "plate"?']),
        (PLATE.replace('kind = "plate"', "kind = 3"), ["kind: 3 is not one of stator, plate"]),
        (PLATE.replace('kind = "plate"\n', ""), ['unknown key "plate"']),
        (BEAM.replace("height_mm = 16.0", "height_mm = -1.0"), ["beam.height_mm", "greater than 0"]),
        (BEAM.replace('"z"', '"x"'), ['"x" is not one of z']),
        (TUBE.replace("length_mm = 150.0", ""), ["tube.length_mm: is missing"]),
    ],
)
def test_faults_of_the_geometry(folder: Path, geometry: str, fragments: list[str]) -> None:
    refused_study(write_study(folder, geometry, study_text("plate", "isotropic", 0.5, TABLE)), *fragments)


@pytest.mark.parametrize(
    ("old", "new", "fragments"),
    [
        ('kind = "coupon"', 'kind = "stack"', ["stages[plate]"]),
        ("plate = ", "tube = ", ["stages[plate].model.tube", "declare plate instead"]),
        ('plate = "isotropic"\n', "", ["nothing is declared", "plate or beam or tube"]),
        ('"isotropic"', '"isotrop"', ["isotrop", "did you mean"]),
        ('support = "free"', 'support = "clamped"', ["coupons are computed free only"]),
        ("mass_kg = 0.5", "mass_kg = 0.0", ["mass_kg", "greater than 0"]),
    ],
)
def test_faults_of_the_study(folder: Path, old: str, new: str, fragments: list[str]) -> None:
    text = study_text("plate", "isotropic", 0.5, TABLE)
    assert old in text
    refused_study(write_study(folder, PLATE, text.replace(old, new, 1)), *fragments)


@pytest.mark.parametrize(
    ("identify", "fragments"),
    [
        ("fixed.plate.nu_12 = 1.4", ["nu_12", "no Poisson ratio"]),
        ("fixed.plate.E_r_pa = 1e9", ['no constant "E_r_pa"', "E_1_pa"]),
        ("fixed.plate.G_12_pa = -1.0", ["G_12_pa", "greater than 0"]),
        ("fixed.lamination.E_1_pa = 1e9", ['no region "lamination"', '"plate"']),
    ],
)
def test_constants_of_orthotropic_coupons_are_numbered(
    folder: Path, identify: str, fragments: list[str]
) -> None:
    text = study_text("plate", "orthotropic", 0.5, TABLE, identify)
    refused_study(write_study(folder, PLATE, text), *fragments)


def test_a_coupon_is_the_one_stage(folder: Path) -> None:
    text = study_text("plate", "isotropic", 0.5, TABLE)
    second = '[[stages]]\nname = "again"\nkind = "coupon"\nmass_kg = 0.6\n'
    refused_study(write_study(folder, PLATE, text + second), "a coupon is the one stage of its study")
