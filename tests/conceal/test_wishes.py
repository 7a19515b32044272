"""What the command line asks to conceal."""

from __future__ import annotations

import pytest

from statorhom.conceal.conceal_study import Wish
from statorhom.conceal.wishes import wishes_from
from statorhom.errors import InputFileError


def test_settings_belong_to_the_only_effect() -> None:
    found = wishes_from(["attached_mass"], ["mass_kg=0.05", "angle_deg = 60"], 0.3, "stack", None)
    assert found == (Wish("attached_mass", {"mass_kg": 0.05, "angle_deg": 60.0}, 0.3, "stack", None),)


def test_of_two_effects_a_setting_says_whose_it_is() -> None:
    lump, oval = wishes_from(["attached_mass", "ovality"], ["ovality.angle_deg=9"], None, None, None)
    assert (lump.given, oval.given) == ({}, {"angle_deg": 9.0})


@pytest.mark.parametrize("setting", ["mass_kg", "mass_kg=heavy", "mass_kg=nan", "=3", "ovality.mass_kg=1"])
def test_refusals_are_one_line(setting: str) -> None:
    with pytest.raises(InputFileError, match="--set") as caught:
        wishes_from(["attached_mass"], [setting], None, None, None)
    assert "\n" not in str(caught.value)


def test_of_two_effects_an_unnamed_setting_is_refused() -> None:
    with pytest.raises(InputFileError, match="EFFECT"):
        wishes_from(["attached_mass", "ovality"], ["angle_deg=9"], None, None, None)
