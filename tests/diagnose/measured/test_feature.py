"""Residuals, and how they are held down."""

from __future__ import annotations

from typing import Any

import pytest
from scipy.stats import norm

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


def test_a_model_that_is_not_sure_pays_for_it_as_a_normal_density_does() -> None:
    """Both explain a line at 3e-3; the one that knew it to 1e-3 says more than the one that knew it to 0.1."""
    sure, unsure = (Feature("frequency", "free", None, 3e-3, 0.0, sd, least=1e-3) for sd in (1e-3, 0.1))
    log_densities = [norm.logpdf(3e-3, scale=f.sd) - norm.logpdf(0.0, scale=f.least) for f in (sure, unsure)]
    assert [-0.5 * f.residual**2 - f.doubt for f in (sure, unsure)] == pytest.approx(log_densities)
    assert log_densities[1] > log_densities[0] - 0.5


@pytest.mark.parametrize("told", [{"lost": True, "least": 1e-3}, {}])
def test_a_penalty_and_what_is_no_prediction_are_sure(told: dict[str, Any]) -> None:
    assert Feature("frequency", "free", None, 0.0, 0.0, 1.0, **told).doubt == 0.0
