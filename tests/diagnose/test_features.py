"""Residuals of single features."""

from __future__ import annotations

import numpy as np
import pytest

from statorhom.diagnose.features import KNEE, LINEAR, held_down, shift_features
from statorhom.diagnose.measured import MeasuredTest, PlaneShifts


def test_residuals_are_linear_up_to_the_knee_and_smooth_beyond() -> None:
    assert held_down(LINEAR) == LINEAR
    assert held_down(-3.0) == -3.0
    assert held_down(1e4) < LINEAR + KNEE * 10
    slope = (held_down(LINEAR + 1e-6) - held_down(LINEAR - 1e-6)) / 2e-6
    assert slope == pytest.approx(1.0, abs=1e-3)


def test_the_right_sensor_mass_leaves_nothing() -> None:
    z, amplitude = np.linspace(0.0, 0.1, 9), np.linspace(-1.0, 1.0, 9)
    places = np.array([0.005, 0.035, 0.065, 0.095])
    square = np.interp(places, z, amplitude) ** 2
    shift = -0.5 * 0.01 * (square - square.mean())
    shifts = PlaneShifts("1", places, shift, np.full(4, 1e-5), 0.0)
    test = MeasuredTest(0, "free", "free", (), True, (), (shifts,))
    key = (2, 1, 0)
    right = shift_features(test, {"1": key}, {key: (z, amplitude)}, 0.01)
    none = shift_features(test, {"1": key}, {key: (z, amplitude)}, 0.0)
    assert max(abs(f.residual) for f in right) < 1e-6
    assert max(abs(f.residual) for f in none) > 3.0
