"""Every effect that can be concealed: it finds its place, states what was set, and changes the truth."""

from __future__ import annotations

import numpy as np
import pytest

from concealed_rings import full_case
from statorhom.conceal.library import hidden_effect, library
from statorhom.conceal.place_effect import places, with_effect
from statorhom.errors import InputFileError
from statorhom.physics.library import library as known_effects

CASE = full_case()


def concealed(name: str, **options):
    return with_effect(CASE, library()[name], np.random.default_rng(3), **options)


def test_everything_that_a_diagnosis_can_name_can_be_concealed() -> None:
    stated = {concealed(name).findings[-1].effect for name, e in library().items() if e.in_library}
    assert set(known_effects()) <= stated


@pytest.mark.parametrize("name", sorted(library()))
def test_truth_changes_and_says_so(name: str) -> None:
    case = concealed(name)
    finding = case.findings[-1]
    assert case.verdict == ("named" if library()[name].in_library else "unknown")
    assert finding.stage in {stage.keys.name for stage in case.stages}
    assert (case.stages, case.study, case.geometry_file) != (CASE.stages, CASE.study, CASE.geometry_file)


@pytest.mark.parametrize("name", sorted(library()))
def test_given_parameters_are_what_is_stated(name: str) -> None:
    effect = library()[name]
    drawn = effect.parameters(places(CASE, effect)[0])
    strengths = {p.name: p.at(0.4) for p in drawn if p.is_strength}
    stated = concealed(name, given=strengths).findings[-1].parameters
    for key, value in strengths.items():
        if key in stated and not isinstance(stated[key], list):
            assert stated[key] == value


def test_strength_decides_magnitude_and_not_the_place() -> None:
    weak, strong = (concealed("attached_mass", strength=s).findings[-1] for s in (0.1, 0.9))
    assert strong.parameters["mass_kg"] > 5 * weak.parameters["mass_kg"]
    assert strong.angle_deg == weak.angle_deg


def test_a_mass_typed_wrongly_is_the_right_one_with_other_digits() -> None:
    for seed in range(20):
        case = with_effect(CASE, library()["wrong_input"], np.random.default_rng(seed))
        p = case.findings[-1].parameters
        assert p["value"] != p["in_file"] == case.study["stages"][0]["mass_kg"]
        assert sum(a != b for a, b in zip(f"{p['value']:.3f}", f"{p['in_file']:.3f}", strict=True)) in (1, 2)
        assert p["in_file"] < case.study["stages"][1]["mass_kg"]


def test_sheets_that_slide_are_declared_isotropic() -> None:
    case = concealed("interlaminar_shear")
    assert case.study["stages"][0]["model"]["lamination"] == "isotropic"
    assert {s.materials["lamination"].symmetry for s in case.stages} == {"transversely_isotropic"}


def test_a_light_winding_still_weighs_on_the_scale() -> None:
    case = concealed("loose_winding_mass", given={"participating_fraction": 0.5})
    before, after = CASE.stages[1], case.stages[1]
    assert after.materials["winding"].density == 0.5 * before.materials["winding"].density
    assert after.scale_kg == before.scale_kg


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"given": {"mas_kg": 1.0}}, "mass_kg"),
        ({"stage": "nowhere"}, "nowhere"),
        ({"test": "clamped-test"}, "clamped-test"),
    ],
)
def test_refusals_name_what_is_wrong(options: dict, message: str) -> None:
    with pytest.raises(InputFileError, match=message) as caught:
        concealed("attached_mass", **options)
    assert "\n" not in str(caught.value)


def test_an_unknown_effect_is_refused() -> None:
    with pytest.raises(InputFileError, match="attached_mass"):
        hidden_effect("atached_mass")
