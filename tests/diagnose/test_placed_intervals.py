"""Intervals of magnitudes: what all splits share does not average out."""

from __future__ import annotations

import numpy as np
import pytest

from statorhom.diagnose.report_rows import TOGETHER, _note, _shape_spread
from statorhom.physics.candidate import Candidate
from statorhom.physics.library import library
from statorhom.physics.parameter import EffectParameter, angle

LUMP, STRIP = "attached_mass", "local_stiffness"
MASS = EffectParameter("mass_kg", 0.01, 0.1, 1e-3, 1.0, "log", (0.03,), None)
RATIO = EffectParameter("stiffness_ratio", 0.5, 2.0, 0.1, 4.0, "linear", (1.2,), 1.0)


def test_a_local_magnitude_is_known_no_better_than_its_shape() -> None:
    lump = Candidate(LUMP, "stack", (MASS, angle()))
    z = MASS.internal(0.05)
    spread = _shape_spread(lump, MASS, z)
    assert np.log(MASS.value(z + spread) / 0.05) == pytest.approx(library()[LUMP].open_by_shape, rel=1e-3)


def test_a_ratio_is_one_of_its_distance_from_what_is_absent() -> None:
    strip, z = Candidate(STRIP, "stack", (RATIO, angle())), RATIO.internal(1.4)
    expected = 0.4 * library()[STRIP].open_by_shape
    assert RATIO.value(z + _shape_spread(strip, RATIO, z)) - 1.4 == pytest.approx(expected, rel=1e-3)


def test_what_has_no_place_has_no_shape() -> None:
    assert _shape_spread(Candidate(LUMP, "stack", (MASS,)), MASS, 0.3) == 0.0


@pytest.mark.parametrize(
    ("interval", "told"), [((0.65, 3.84), True), ((1.1, 3.84), False), ((0.2, 0.9), False)]
)
def test_a_name_whose_interval_holds_its_absence_says_why(interval: tuple[float, float], told: bool) -> None:
    strip = Candidate(STRIP, "stack", (RATIO, angle()))
    intervals = {"stiffness_ratio": interval, "width_deg": (5.0, 20.0)}
    note = _note("modulus of a strip", strip, intervals)
    assert note == (f"modulus of a strip; {TOGETHER}" if told else "modulus of a strip")
    assert _note(None, strip, intervals) == (TOGETHER if told else None)
    # of one size nothing is told by what several come to
    assert _note("modulus of a strip", strip, {"stiffness_ratio": interval}) == "modulus of a strip"
    # a mass is never none at all on its scale
    lump = Candidate(LUMP, "stack", (MASS, angle()))
    assert _note("a lump", lump, {"mass_kg": interval}) == "a lump"
