"""The library as a whole: names of the contract, priors inside limits, actions at every start."""

from __future__ import annotations

from pathlib import Path

import pytest

from statorhom.physics.action import Action
from statorhom.physics.library import all_candidates, library, look_alike
from statorhom.study.study import StudyFiles, load_study

CONTRACT = {
    "interlaminar_shear", "stack_pressure_gradient", "support_compliance", "suspension_stiffness", "sensor_mass",
    "attached_mass", "local_stiffness", "ovality", "end_winding_stiffness", "interface_debond", "loose_winding_mass",
    "dry_friction", "viscoelastic_winding", "press_fit_contact", "temperature_shift", "wrong_input", "mislabelled_mode",
}  # fmt: skip
GEOMETRY = """\
schema = 1
name = "small"
[core]
outer_diameter_mm = 120.0
bore_diameter_mm = 70.0
length_mm = 80.0
yoke_thickness_mm = 9.0
[slots]
count = 12
shape = "parallel_tooth"
tooth_width_mm = 8.0
[winding]
overhang_length_mm = 20.0
[frame]
inner_diameter_mm = 120.0
outer_diameter_mm = 130.0
length_mm = 80.0
offset_mm = 0.0
"""
STUDY = """\
schema = 1
name = "small"
geometry = "small.toml"
[[supports]]
name = "clamped"
kind = "lines"
angles_deg = [150.0, 210.0]
declared = "rigid"
[[stages]]
name = "stack"
kind = "stack"
mass_kg = 3.0
model = { lamination = "isotropic" }
[[stages.tests]]
name = "free"
support = "free"
modal_table = "modes.csv"
[[stages.tests]]
name = "held"
support = "clamped"
modal_table = "modes.csv"
[[stages]]
name = "wound"
kind = "wound"
mass_kg = 4.2
model = { winding = "isotropic" }
[[stages.tests]]
name = "wound-free"
support = "free"
modal_table = "modes.csv"
[[stages]]
name = "framed"
kind = "framed"
mass_kg = 5.0
model = { frame = "isotropic" }
[[stages.tests]]
name = "framed-free"
support = "free"
modal_table = "modes.csv"
"""
MODES = "frequency_hz,order,axial\n1400,2,0\n1900,2,1\n3700,3,0\n"


@pytest.fixture
def files(tmp_path: Path) -> StudyFiles:
    (tmp_path / "small.toml").write_text(GEOMETRY)
    (tmp_path / "study.toml").write_text(STUDY)
    (tmp_path / "modes.csv").write_text(MODES)
    return load_study(tmp_path / "study.toml")


def test_names_are_those_of_the_contract() -> None:
    assert set(library()) == CONTRACT


def test_every_confusion_is_with_an_effect_of_the_contract() -> None:
    for effect in library().values():
        assert effect.summary and effect.citation
        assert {c.effect for c in effect.confused_with} <= CONTRACT - {effect.name}


@pytest.mark.parametrize(
    ("effects", "confused"),
    [
        (("viscoelastic_winding", "end_winding_stiffness"), True),
        (("loose_winding_mass", "end_winding_stiffness"), True),  # the other one alone says so
        (("loose_winding_mass", "viscoelastic_winding"), False),
        (("end_winding_stiffness", "end_winding_stiffness"), False),
    ],
)
def test_two_look_alike_where_either_says_so(
    files: StudyFiles, effects: tuple[str, str], confused: bool
) -> None:
    one, other = (next(c for c in all_candidates(files) if c.effect == effect) for effect in effects)
    assert look_alike(one, other, files) == look_alike(other, one, files) == confused


def test_candidates_of_a_chain(files: StudyFiles) -> None:
    found = {c.effect for c in all_candidates(files)}
    # sensors rove in recordings only, friction takes several force levels
    assert found == set(library()) - {"sensor_mass", "stack_pressure_gradient", "dry_friction"}
    labels = [c.label for c in all_candidates(files)]
    assert len(labels) == len(set(labels))


def test_priors_lie_inside_physical_limits(files: StudyFiles) -> None:
    for candidate in all_candidates(files):
        for p in candidate.parameters:
            assert p.lower <= p.low90 < p.high90 <= p.upper, candidate.label
            assert p.located or p.starts, candidate.label
            assert all(p.lower < s < p.upper for s in p.starts)


def test_friction_takes_two_force_levels(files: StudyFiles) -> None:
    text = files.path.read_text()
    test = 'name = "free"\nsupport = "free"\nmodal_table = "modes.csv"\n'
    assert test in text
    for second, count in ((2.0, 0), (20.0, 2)):
        again = test.replace('"free"\nsupport', '"again"\nsupport') + f"force_level_n = {second}\n"
        files.path.write_text(text.replace(test, test + f"force_level_n = 2.0\n[[stages.tests]]\n{again}"))
        found = library()["dry_friction"].candidates(load_study(files.path))
        assert len(found) == count
        assert len({c.label for c in found}) == count


def test_every_start_acts(files: StudyFiles) -> None:
    for candidate in all_candidates(files):
        values = {
            p.name: p.starts[0] if p.starts else 0.5 * (p.lower + p.upper) for p in candidate.parameters
        }
        action = library()[candidate.effect].action(candidate, values, files)
        assert action != Action()
        assert library()[candidate.effect].reported(candidate, values)


def test_a_declared_effect_is_no_candidate(files: StudyFiles) -> None:
    names = {c.effect for c in all_candidates(files)}
    assert "interlaminar_shear" in names
    declared = files.path.read_text().replace(
        'lamination = "isotropic"', 'lamination = "transversely_isotropic"'
    )
    files.path.write_text(
        declared.replace('declared = "rigid"', 'declared = "elastic"\nnormal_stiffness_n_per_m2 = 1e9')
    )
    names = {c.effect for c in all_candidates(load_study(files.path))}
    assert "interlaminar_shear" not in names
    assert "support_compliance" not in names
