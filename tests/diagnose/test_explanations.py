"""Whether an explanation is adequate."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.stats import chi2

from statorhom.diagnose.explanations import Explanation
from statorhom.diagnose.refit import Refit


def explanation(constant: float, magnitude: float) -> Explanation:
    """Ten features that are met to 8 units of squared residual; a constant and an effect's magnitude."""
    hypothesis = SimpleNamespace(constants=1, prior_weights=np.ones(2), missed=3.0)
    objective = 8.0 + 3.0 + constant**2 + magnitude**2
    refit = Refit(hypothesis, np.array([constant, magnitude]), np.zeros((10, 2)), 8.0, objective)  # type: ignore[arg-type]
    return Explanation((), refit, 0.0)


def test_a_large_effect_is_no_misfit() -> None:
    assert explanation(0.0, 5.0).adequacy == pytest.approx(float(chi2.sf(8.0, 10)))


def test_an_implausible_constant_is_one() -> None:
    assert explanation(6.0, 0.0).adequacy == pytest.approx(float(chi2.sf(44.0, 10)))
