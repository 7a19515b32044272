from __future__ import annotations

import math
from pathlib import Path

import pytest

from cheap_study import append, edit, write_study
from statorhom.errors import IdentificationError, InputFileError, MassError
from statorhom.geometry.stator import stator_geometry
from statorhom.identify.stages.stage_setup import StageSetup, analytic_values, check_fit, stage_setup
from statorhom.study.study import StudyFiles, load_study


def read(path: Path) -> StudyFiles:
    return load_study(path)


def setup(path: Path, index: int) -> StageSetup:
    files = read(path)
    return stage_setup(files, stator_geometry(files.geometry, files.geometry_path), index)


def test_a_framed_stage(tmp_path: Path) -> None:
    framed = setup(write_study(tmp_path), 1)
    assert framed.new == {"frame"}
    assert framed.materials.sources == {"lamination": "isotropic", "frame": "isotropic"}
    volume = math.pi * (0.064**2 - 0.06**2) * 0.06
    assert framed.densities["frame"].density_kg_m3 == pytest.approx((2.565 - 2.313) / volume)
    # both weighings are uncertain by 5 g
    assert framed.densities["frame"].density_sd_kg_m3 == pytest.approx(math.sqrt(2) * 0.005 / volume)
    assert [mode.frequency_hz for mode in framed.fitted] == [3600.0, 5230.0]
    assert framed.free_modes == framed.fitted


def test_held_out_modes_are_not_fitted(tmp_path: Path) -> None:
    study = write_study(tmp_path)
    append(study, "hold_out = [1]\n")
    (test,) = setup(study, 1).tests
    assert [mode.frequency_hz for mode in test.fitted] == [5230.0]
    assert [mode.frequency_hz for mode in test.held_out] == [3600.0]
    assert [mode.frequency_hz for mode in test.modes] == [3600.0, 5230.0]


def test_a_test_that_only_predicts(tmp_path: Path) -> None:
    study = write_study(tmp_path)
    append(study, 'role = "predict"\n')
    (test,) = setup(study, 1).tests
    assert test.fitted == () and len(test.held_out) == 2


SUPPORTED = """
[[stages.tests]]
name = "framed-clamped"
support = "clamped"
modal_table = "framed.csv"
"""
SUPPORT = (
    '[[supports]]\nname = "clamped"\nkind = "lines"\nangles_deg = [0.0, 90.0]\ndeclared = "rigid"\n[[stages]]'
)


def test_supported_tests_are_predicted_unless_told_otherwise(tmp_path: Path) -> None:
    study = write_study(tmp_path)
    edit(study, "[[stages]]", SUPPORT)
    append(study, SUPPORTED)
    found = setup(study, 1)
    assert [(test.support, len(test.fitted)) for test in found.tests] == [("free", 2), ("clamped", 0)]
    assert len(found.free_modes) == 2
    append(study, 'role = "fit"\n')
    with pytest.raises(IdentificationError, match=r"study\.toml: test 'framed-clamped': role"):
        setup(study, 1)


def test_weights_that_contradict_each_other_name_their_file(tmp_path: Path) -> None:
    study = write_study(tmp_path)
    edit(study, "2.565", "2.165")
    with pytest.raises(MassError, match=r"^\S+study\.toml: mass_kg: 2\.165 kg after 'framed'.*0\.148 kg"):
        setup(study, 1)
    assert setup(study, 0).densities["lamination"].mass_kg == 2.313


def test_a_step_without_dimensions_and_tests_is_a_weight(tmp_path: Path) -> None:
    study = write_study(tmp_path)
    append(study, '[[stages]]\nname = "done"\nkind = "machine"\nmass_kg = 3.0\n')
    done = setup(study, 2)
    assert done.step is None and done.densities == {} and done.new == frozenset()
    edit(study, "mass_kg = 3.0", "mass_kg = 2.5")
    with pytest.raises(MassError, match=r"a loss of 0\.065 kg"):
        setup(study, 2)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("evaluations = 60", "evaluations = 49", r"stages\[stack\].identify.evaluations: 49 .* at least 50"),
        (
            "chains = 1",
            "chains = 2",
            r"stages\[stack\].identify.evaluations: 60 .* 2 chains; .* at least 100",
        ),
        ('"stack.csv"', '"stack.csv"\nhold_out = [1, 2]', r"stages\[stack\]: no mode is left to fit"),
    ],
)
def test_what_cannot_be_fitted_is_refused(old: str, new: str, message: str, tmp_path: Path) -> None:
    study = write_study(tmp_path)
    check_fit(read(study), setup(study, 0))
    edit(study, old, new)
    with pytest.raises(InputFileError, match=message):
        check_fit(read(study), setup(study, 0))


def test_sheets_give_the_lamination_a_start(tmp_path: Path) -> None:
    study = write_study(tmp_path)
    assert analytic_values(read(study), setup(study, 0), {}) == {}
    append(tmp_path / "ring.toml", "[lamination]\nsheet_thickness_mm = 0.5\ncoating_thickness_mm = 0.005\n")
    found = analytic_values(read(study), setup(study, 0), {})
    lamination = found["lamination"]
    # the stack is softer across its sheets than in them, and as stiff in them as steel
    assert lamination is not None and 190e9 < lamination.E_p_pa < 210e9
    assert lamination.E_z_pa < lamination.E_p_pa
    # a frame learns nothing from sheets
    assert analytic_values(read(study), setup(study, 1), {}) == {}


def untested(study: Path, stage: str) -> None:
    """Take the tests of a stage away."""
    text = study.read_text(encoding="utf-8")
    begin = text.index(f'[[stages.tests]]\nname = "{stage}-free"')
    end = text.find("[[stages]]", begin)
    study.write_text(text[:begin] + (text[end:] if end > 0 else ""), encoding="utf-8")


def test_what_an_untested_step_added_is_identified_with_the_next_test(tmp_path: Path) -> None:
    study = write_study(tmp_path)
    untested(study, "stack")
    assert setup(study, 0).new == {"lamination"}
    assert setup(study, 1).new == {"lamination", "frame"}


def test_what_a_tested_step_identified_stays(tmp_path: Path) -> None:
    study = write_study(tmp_path)
    edit(tmp_path / "ring.toml", "length_mm = 60.0\noffset_mm = 0.0", "length_mm = 100.0\noffset_mm = -20.0")
    append(tmp_path / "ring.toml", "[machine]\nshield_thickness_mm = 5.0\nshield_bore_diameter_mm = 40.0\n")
    append(
        study,
        '[[stages]]\nname = "done"\nkind = "machine"\nmass_kg = 3.0\n[stages.model]\nmachine = "isotropic"\n'
        '[[stages.tests]]\nname = "done-free"\nsupport = "free"\nmodal_table = "framed.csv"\n',
    )
    assert setup(study, 2).new == {"machine"}
    untested(study, "framed")
    text = study.read_text(encoding="utf-8")
    assert "done-free" in text
    assert setup(study, 2).new == {"machine", "frame"}
