"""Effects that a study declares: read with the library's keys, refused in one line, written as they are read."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from cheap_study import append, write_study
from statorhom.errors import InputFileError
from statorhom.physics.action import Action
from statorhom.physics.declared import beyond, declared_effects, effect_table
from statorhom.physics.library import all_candidates
from statorhom.study.study import StudyFiles, load_study

LUMP = """
[[stages.effects]]
effect = "attached_mass"
mass_kg = 0.05
angle_deg = 100.0
z_mm = 20.0
"""
OVAL = """
[[stages.effects]]
effect = "ovality"
harmonic = 4
relative_amplitude = 0.01
angle_deg = 100.0
"""


def study_with(folder: Path, table: str, stage: str = "framed") -> StudyFiles:
    """The cheap study with a table at the end of a stage."""
    path = write_study(folder)
    if stage == "framed":
        append(path, table)
    else:
        text = path.read_text(encoding="utf-8")
        head, tail = text.split('\n[[stages]]\nname = "framed"')
        path.write_text(f'{head}{table}\n[[stages]]\nname = "framed"{tail}', encoding="utf-8")
    return load_study(path)


def test_a_lump_stands_in_units_that_users_type(tmp_path: Path) -> None:
    (found,) = declared_effects(study_with(tmp_path, LUMP))
    assert found.candidate.effect == "attached_mass" and found.candidate.stage == "framed"
    # a detail that the table leaves open is as usual
    usual = {"cog_height_mm": 8.0}
    assert found.values == pytest.approx(
        {"mass_kg": 0.05, "angle_rad": np.deg2rad(100.0), "z_m": 0.02} | usual
    )
    assert found.action.touches("framed") and not found.action.touches("stack")
    assert found.action.changes is not None


def test_choices_tell_candidates_and_angles_come_into_their_period(tmp_path: Path) -> None:
    (found,) = declared_effects(study_with(tmp_path, OVAL, "stack"))
    assert found.candidate.chosen == {"harmonic": 4}
    assert found.values["angle_rad"] == pytest.approx(np.deg2rad(10.0))


def test_every_effect_of_the_library_is_read_as_it_is_written(tmp_path: Path) -> None:
    files = load_study(write_study(tmp_path / "plain"))
    checked = set()
    for number, candidate in enumerate(all_candidates(files)):
        if not candidate.parameters or candidate.effect in checked:
            continue
        values = {p.name: 0.3 * p.lower + 0.7 * p.upper for p in candidate.parameters}
        rows = effect_table(candidate, values)
        lines = [f"{k} = {v!r}".replace("'", '"') for k, v in rows.items()]
        table = "\n".join(["", "[[stages.effects]]", *lines, ""])
        again = study_with(tmp_path / str(number), table, candidate.stage)
        try:
            (found,) = declared_effects(again)
        except InputFileError as error:
            assert "is no entry of effects" in str(error)  # what other keys say
            continue
        assert found.candidate.label == candidate.label
        assert found.values == pytest.approx(values)
        checked.add(candidate.effect)
    assert {"attached_mass", "local_stiffness", "ovality", "suspension_stiffness"} <= checked


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('"attached_mass"', '"atached_mass"', 'did you mean "attached_mass"?'),
        ("mass_kg = 0.05", "mass_g = 50.0", 'unknown key "mass_g"; did you mean "mass_kg"?'),
        ("angle_deg = 100.0\n", "", "angle_deg: is missing"),
        ("z_mm = 20.0", "z_mm = 200.0", "use a number of 0 … 60"),
        ("z_mm = 20.0", 'z_mm = "top"', "must be a number"),
        ("z_mm = 20.0", "z_mm = [1.0]", "must be a number or text"),
        ("z_mm = 20.0", 'z_mm = 20.0\nregion = "frame"', 'cannot be "frame"'),
    ],
)
def test_what_is_wrong_is_one_line(tmp_path: Path, old: str, new: str, message: str) -> None:
    assert old in LUMP
    with pytest.raises(InputFileError) as caught:
        declared_effects(study_with(tmp_path, LUMP.replace(old, new)))
    assert message in str(caught.value) and "\n" not in str(caught.value)


def test_what_other_keys_say_is_refused(tmp_path: Path) -> None:
    table = '\n[[stages.effects]]\neffect = "wrong_input"\ninput = "mass_kg"\nvalue = 2.5\n'
    with pytest.raises(InputFileError, match="correct mass_kg instead"):
        declared_effects(study_with(tmp_path, table))


def test_an_open_choice_is_asked_for(tmp_path: Path) -> None:
    with pytest.raises(InputFileError, match="harmonic: is missing; add it: one of 2, 4, 6, 8"):
        declared_effects(study_with(tmp_path, OVAL.replace("harmonic = 4\n", ""), "stack"))


def test_what_is_beyond_the_understood_is_named() -> None:
    assert beyond(Action(sensor_kg=0.01), ("materials",)) == "sensor_kg"
    assert beyond(Action(sensor_kg=0.01), ("sensor_kg",)) is None
    assert beyond(Action(stages=frozenset({"a"})), ()) is None
