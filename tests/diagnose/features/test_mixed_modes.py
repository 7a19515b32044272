"""What the way costs in which modes are called by a name."""

from __future__ import annotations

import numpy as np
import pytest

from statorhom.diagnose.features.mixed_modes import charges_of, cost_of
from statorhom.diagnose.measured.feature import Feature


def features(*chances: float) -> list[Feature]:
    """Each a standard deviation off."""
    return [Feature("frequency", "t", (2, 0, 0), 1.0, 0.0, 1.0, chance=chance) for chance in chances]


def test_a_chance_costs_its_logarithm_and_certainty_nothing() -> None:
    assert charges_of(features(1.0, 0.5)).tolist() == [0.0, pytest.approx(np.sqrt(2 * np.log(2)))]
    assert cost_of(features(1.0, 0.5)) == pytest.approx(2 + 2 * np.log(2))
    assert cost_of([]) == 0.0


def test_the_charge_rises_from_nothing_with_a_slope() -> None:
    """As residuals do, whose squares least squares can follow: a chance falls with the square of what is mixed."""
    little, twice = charges_of(features(1 - 1e-8, 1 - 4e-8))
    assert little == pytest.approx(np.sqrt(2e-8), rel=1e-3)
    assert twice == pytest.approx(2 * little, rel=1e-3)
