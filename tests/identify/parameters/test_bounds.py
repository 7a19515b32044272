"""The box and its mirrors."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from statorhom.identify.parameters.bounds import Bounds

coordinate = st.floats(-1e3, 1e3)


@settings(deadline=None)
@given(coordinate, st.floats(1e-3, 1e2), coordinate)
def test_reflection_stays_inside_and_leaves_inner_points_alone(lower, width, x):
    bounds = Bounds([lower, lower, -np.inf, -np.inf], [lower + width, np.inf, lower, np.inf])
    point = np.full(4, x)
    reflected = bounds.reflect(point)
    assert bounds.contains(reflected)
    inside = (point >= bounds.lower) & (point <= bounds.upper)
    np.testing.assert_allclose(reflected[inside], point[inside], rtol=1e-9, atol=1e-9)


def test_reflection_is_that_of_two_mirrors():
    bounds = Bounds([0.0], [1.0])
    points = np.array([[-0.25], [1.25], [2.25], [-1.25]])
    np.testing.assert_allclose(bounds.reflect(points)[:, 0], [0.25, 0.75, 0.25, 0.75])


def test_reflected_walk_is_uniform():
    rng = np.random.default_rng(0)
    bounds = Bounds([0.0], [1.0])
    points = np.full((20000, 1), 0.9)
    for _ in range(30):
        points = bounds.reflect(points + 0.4 * rng.standard_normal(points.shape))
    assert np.abs(np.histogram(points, bins=10, range=(0, 1))[0] / 2000 - 1.0).max() < 0.12


@pytest.mark.parametrize("limits", [([0.0], [0.0]), ([0.0], [np.nan]), ([0.0, 1.0], [1.0])])
def test_an_impossible_box_is_refused(limits):
    with pytest.raises(ValueError, match="bound"):
        Bounds(*limits)


def test_limits_cannot_be_changed():
    with pytest.raises(ValueError, match="read-only"):
        Bounds([0.0], [1.0]).lower[0] = 3.0
