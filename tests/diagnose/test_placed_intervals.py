"""Intervals of magnitudes: what all splits share does not average out."""

from __future__ import annotations

import numpy as np
import pytest

from statorhom.diagnose.report_rows import _shape_spread
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
