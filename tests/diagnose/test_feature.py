"""Residuals, and how they are held down."""

from __future__ import annotations

import pytest

from statorhom.diagnose.feature import KNEE, LINEAR, held_down


def test_residuals_are_linear_up_to_the_knee_and_smooth_beyond() -> None:
    assert held_down(LINEAR) == LINEAR
    assert held_down(-3.0) == -3.0
    assert held_down(1e4) < LINEAR + KNEE * 10
    slope = (held_down(LINEAR + 1e-6) - held_down(LINEAR - 1e-6)) / 2e-6
    assert slope == pytest.approx(1.0, abs=1e-3)
