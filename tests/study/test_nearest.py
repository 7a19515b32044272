from __future__ import annotations

import pytest

from statorhom.study.nearest import hint

KEYS = ("mass_kg", "mass_sd_kg", "model", "tests")


@pytest.mark.parametrize(
    ("typed", "meant"),
    [("mass", "mass_kg"), ("Mass_kg", "mass_kg"), ("mass_std_kg", "mass_sd_kg"), ("test", "tests")],
)
def test_the_likely_name_is_asked_for(typed: str, meant: str) -> None:
    assert hint(typed, KEYS) == f'did you mean "{meant}"?'


def test_far_from_all_names_lists_them() -> None:
    text = hint("xyzw", KEYS)
    assert text.startswith("the nearest known name is")
    assert text.endswith("(known: mass_kg, mass_sd_kg, model, tests)")
