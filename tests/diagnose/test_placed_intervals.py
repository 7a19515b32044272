"""Intervals of magnitudes: what all splits share does not average out."""

from __future__ import annotations

import numpy as np
import pytest

from statorhom.diagnose.report_rows import _shape_spread
from statorhom.physics.parameter import EffectParameter

PART = 0.05
MASS = EffectParameter("mass_kg", 0.01, 0.1, 1e-3, 1.0, "log", (0.03,), None)
RATIO = EffectParameter("stiffness_ratio", 0.5, 2.0, 0.1, 4.0, "linear", (1.2,), 1.0)


def test_a_local_magnitude_is_known_no_better_than_its_shape() -> None:
    z = MASS.internal(0.05)
    spread = _shape_spread(MASS, z, PART)
    assert np.log(MASS.value(z + spread) / 0.05) == pytest.approx(PART, rel=1e-3)


def test_a_ratio_is_one_of_its_distance_from_what_is_absent() -> None:
    z = RATIO.internal(1.4)
    assert RATIO.value(z + _shape_spread(RATIO, z, PART)) - 1.4 == pytest.approx(0.4 * PART, rel=1e-3)


def test_what_has_no_place_has_no_shape() -> None:
    assert _shape_spread(MASS, 0.3, 0.0) == 0.0
