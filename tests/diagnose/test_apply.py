"""The amended study: what was found stands in it, and it reads back as what was found."""

from __future__ import annotations

import tomllib
from pathlib import Path

import numpy as np
import pytest

from cheap_study import edit, write_study
from statorhom.diagnose.apply import check_not_the_study, write_amended
from statorhom.errors import ResultsError
from statorhom.physics.candidate import Candidate
from statorhom.physics.declared import DeclaredEffect, declared_effects
from statorhom.physics.library import all_candidates, library
from statorhom.study.study import StudyFiles, load_study


def found(files: StudyFiles, effect: str, stage: str, **values: float) -> DeclaredEffect:
    """An effect as a diagnosis names it."""
    candidate: Candidate = next(c for c in all_candidates(files) if (c.effect, c.stage) == (effect, stage))
    usual = {p.name: p.starts[0] for p in candidate.parameters if p.name not in values}
    whole = usual | values
    return DeclaredEffect(candidate, whole, library()[effect].action(candidate, whole, files))


def test_a_lump_is_declared_where_it_was_found(tmp_path: Path) -> None:
    files = load_study(write_study(tmp_path / "study"))
    lump = found(files, "attached_mass", "framed", mass_kg=0.05123456, angle_rad=np.deg2rad(100.0), z_m=0.02)
    path = write_amended(files, [lump], tmp_path / "out")
    again = load_study(path)
    assert [stage.tests[0].name for stage in again.study.stages] == ["stack-free", "framed-free"]
    (read,) = declared_effects(again)
    assert read.candidate.label == lump.candidate.label
    assert read.values == pytest.approx(dict(lump.values), rel=1e-5)
    assert again.tables["framed-free"].modes == files.tables["framed-free"].modes


def test_a_second_effect_stands_beside_the_first(tmp_path: Path) -> None:
    files = load_study(write_study(tmp_path / "study"))
    first = found(files, "attached_mass", "stack", mass_kg=0.05, angle_rad=1.0, z_m=0.02)
    amended = load_study(write_amended(files, [first], tmp_path / "one"))
    second = found(amended, "ovality", "stack", relative_amplitude=0.01, angle_rad=0.5)
    both = load_study(write_amended(amended, [second], tmp_path / "two"))
    assert [d.candidate.effect for d in declared_effects(both)] == ["attached_mass", "ovality"]


def test_what_other_keys_say_is_corrected_there(tmp_path: Path) -> None:
    files = load_study(write_study(tmp_path / "study"))
    shear = found(files, "interlaminar_shear", "stack", G_rz_pa=2e10, E_z_pa=5e10)
    mass = found(files, "wrong_input", "framed", value=2.6)
    again = load_study(write_amended(files, [shear, mass], tmp_path / "out"))
    stack, framed = again.study.stages
    assert stack.model.lamination == "transversely_isotropic"
    assert "lamination" not in stack.identify.fixed  # nu = 0.3 is no constant of it
    assert framed.mass_kg == 2.6
    assert declared_effects(again) == ()


def test_the_study_itself_is_never_written_over(tmp_path: Path) -> None:
    files = load_study(write_study(tmp_path))
    before = files.path.read_text(encoding="utf-8")
    with pytest.raises(ResultsError, match="the study's own folder"):
        check_not_the_study(files, tmp_path / "." / "sub" / "..")
    check_not_the_study(files, tmp_path / "out")
    assert files.path.read_text(encoding="utf-8") == before


def test_the_amended_file_is_plain_toml(tmp_path: Path) -> None:
    path = write_study(tmp_path / "study")
    edit(path, 'name = "ring"', 'name = "a \\"ring\\" of Müller"')
    files = load_study(path)
    mass = found(files, "wrong_input", "stack", value=2.4)
    table = tomllib.loads(write_amended(files, [mass], tmp_path / "out").read_text(encoding="utf-8"))
    assert table["name"] == 'a "ring" of Müller'
    assert table["stages"][0]["mass_kg"] == 2.4
