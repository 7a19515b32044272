"""Coordinates of effect parameters."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from statorhom.physics.parameter import EffectParameter, angle, height

RATIO = EffectParameter("ratio", 0.5, 2.0, 0.01, 100.0, "log")


@given(st.floats(0.02, 50.0))
def test_value_and_coordinate_are_inverse(value: float) -> None:
    assert RATIO.value(RATIO.internal(value)) == pytest.approx(value, rel=1e-9)


def test_prior_quantiles_lie_at_the_normal_ones() -> None:
    assert RATIO.internal(2.0) == pytest.approx(1.6448536, rel=1e-6)
    assert RATIO.internal(0.5) == pytest.approx(-1.6448536, rel=1e-6)


@given(st.floats(-50.0, 50.0))
def test_angles_come_back_into_their_period(turn: float) -> None:
    parameter = angle(np.pi / 2)
    value = parameter.value(parameter.internal(0.3) + turn)
    assert 0.0 <= value < np.pi / 2 + 1e-9


def test_values_stay_within_their_limits() -> None:
    assert RATIO.value(1e3) == pytest.approx(100.0)
    assert height(0.08).value(-1e3) == 0.0
