"""Residuals, and how they are held down."""

from __future__ import annotations

import pytest

from statorhom.diagnose.measured.feature import KNEE, LINEAR, Feature, held_down


def test_residuals_are_linear_up_to_the_knee_and_smooth_beyond() -> None:
    assert held_down(LINEAR) == LINEAR
    assert held_down(-3.0) == -3.0
    assert held_down(1e4) < LINEAR + KNEE * 10
    slope = (held_down(LINEAR + 1e-6) - held_down(LINEAR - 1e-6)) / 2e-6
    assert slope == pytest.approx(1.0, abs=1e-3)


@pytest.mark.parametrize("kind", ["frequency", "loss"])
@pytest.mark.parametrize("measured", [0.5, -7.0, 9.0, -40.0])
def test_steepness_is_the_derivative_of_the_residual(kind: str, measured: float) -> None:
    step = 1e-6
    low, high = (Feature(kind, "free", None, measured + s, 0.0, 1.0).residual for s in (-step, step))
    own = Feature(kind, "free", None, measured, 0.0, 1.0).steepness
    assert own == pytest.approx((high - low) / (2 * step), rel=1e-4, abs=1e-9)
