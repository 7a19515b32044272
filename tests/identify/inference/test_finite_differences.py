"""Differences inside a box."""

import numpy as np
import pytest

from statorhom.errors import SolverError
from statorhom.identify.inference.finite_differences import jacobian
from statorhom.identify.parameters.bounds import Bounds

FREE = Bounds([-9.0, -9.0], [9.0, 9.0])


def curved(x):
    return np.array([np.sin(x[0]) * x[1], x[1] ** 3, np.exp(x[0])])


def exact(x):
    return np.array([[np.cos(x[0]) * x[1], np.sin(x[0])], [0.0, 3 * x[1] ** 2], [np.exp(x[0]), 0.0]])


def test_central_differences_are_second_order():
    x = np.array([0.3, -0.8])
    errors = [np.abs(jacobian(curved, x, FREE, step=h) - exact(x)).max() for h in (2e-2, 1e-2)]
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.02)


def test_the_box_is_never_left():
    x = np.array([0.3, -0.8])
    bounds = Bounds([0.3, -9.0], [9.0, -0.8])

    def guarded(point):
        assert bounds.contains(point)
        return curved(point)

    np.testing.assert_allclose(jacobian(guarded, x, bounds), exact(x), rtol=1e-3, atol=1e-3)


def test_one_finite_side_is_enough_and_none_is_an_error():
    x = np.array([1.0, 1.0])
    one_sided = jacobian(lambda p: curved(p) if p[0] <= 1.0 else np.full(3, np.nan), x, FREE)
    np.testing.assert_allclose(one_sided, exact(x), rtol=1e-3, atol=1e-3)
    with pytest.raises(SolverError, match="coordinate 0"):
        jacobian(lambda _: np.full(3, np.inf), x, FREE)


def test_noise_of_an_eigenvalue_solver_does_not_spoil_derivatives():
    rng = np.random.default_rng(0)
    x = np.array([0.3, -0.8])
    noisy = jacobian(lambda p: curved(p) + 1e-9 * rng.standard_normal(3), x, FREE)
    np.testing.assert_allclose(noisy, exact(x), atol=1e-4)
