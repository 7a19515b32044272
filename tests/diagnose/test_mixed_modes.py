"""Mixed modes say less, which is charged; the charge has a slope from the first mixing on."""

from __future__ import annotations

import numpy as np
import pytest

from statorhom.diagnose.mixed_modes import SHARP, mixed_charges, mixed_cost


def test_what_is_not_said_of_mixed_modes_is_charged() -> None:
    """Or whatever mixes all modes would explain everything."""
    # of the mean and of the split: ln of how much wider each is, twice
    assert mixed_cost((0.02,)) == pytest.approx(4 * np.log(0.02 / SHARP), rel=1e-3)
    assert mixed_cost((0.02,), 2.0) == pytest.approx(4 * np.log(0.01 / SHARP), rel=3e-3)
    assert mixed_cost((0.02, 0.0, 0.02)) == pytest.approx(2 * mixed_cost((0.02,)))
    assert mixed_cost(()) == mixed_cost((0.0, 0.0)) == 0.0


def test_the_charge_rises_from_nothing_with_a_slope() -> None:
    """As residuals do, whose squares least squares can follow."""
    nothing, little, twice = mixed_charges((0.0, 1e-6, 2e-6))
    assert nothing == 0.0
    assert little == pytest.approx(np.sqrt(2.0) * 1e-6 / SHARP, rel=1e-3)
    assert twice == pytest.approx(2 * little, rel=1e-3)
