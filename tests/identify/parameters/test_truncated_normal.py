"""Normal draws inside a box, against closed forms."""

import numpy as np
import pytest
from scipy.stats import multivariate_normal, norm, truncnorm

from statorhom.identify.parameters.bounds import Bounds
from statorhom.identify.parameters.truncated_normal import boxed_draws

FREE = np.full(3, np.inf)


def test_without_limits_the_weights_are_equal_and_the_moments_exact():
    covariance = np.array([[2.0, 0.7, 0.1], [0.7, 1.0, -0.3], [0.1, -0.3, 0.5]])
    mean = np.array([3.0, -1.0, 0.0])
    draws = boxed_draws(mean, covariance, Bounds(-FREE, FREE), log2_count=12, seed=1)
    assert draws.log_mass == pytest.approx(0.0, abs=1e-12)
    np.testing.assert_allclose(draws.weights, 1 / 4096, rtol=1e-9)
    np.testing.assert_allclose(draws.points.mean(axis=0), mean, atol=0.01)
    np.testing.assert_allclose(np.cov(draws.points.T), covariance, atol=0.03)


def test_mass_and_moments_of_a_correlated_box():
    covariance = np.array([[1.0, 0.8], [0.8, 1.0]])
    bounds = Bounds([0.5, -2.0], [3.0, 0.2])
    draws = boxed_draws(np.zeros(2), covariance, bounds, log2_count=13, seed=1)
    mass = multivariate_normal(cov=covariance).cdf([3.0, 0.2], lower_limit=[0.5, -2.0])
    assert np.exp(draws.log_mass) == pytest.approx(mass, rel=2e-3)
    assert all(bounds.contains(point) for point in draws.points)
    axes = np.linspace(0.5, 3.0, 801), np.linspace(-2.0, 0.2, 801)
    grid = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)
    density = multivariate_normal(cov=covariance).pdf(grid)
    expected = np.tensordot(density / density.sum(), grid, axes=2)
    np.testing.assert_allclose(draws.weights @ draws.points, expected, atol=4e-3)


@pytest.mark.parametrize(("low", "high"), [(30.0, np.inf), (-np.inf, -30.0), (30.0, 30.001), (-31.0, -30.0)])
def test_far_tails(low, high):
    draws = boxed_draws(np.zeros(1), np.eye(1), Bounds([low], [high]), log2_count=10, seed=1)
    assert draws.weights @ draws.points[:, 0] == pytest.approx(truncnorm.mean(low, high), rel=1e-4)
    log_mass = norm.logsf(low) + np.log1p(-np.exp(norm.logsf(high) - norm.logsf(low))) if low > 0 else None
    if log_mass is not None:
        assert draws.log_mass == pytest.approx(log_mass, rel=1e-9)


def test_an_interval_too_narrow_for_the_distribution_function():
    draws = boxed_draws(np.zeros(1), np.eye(1), Bounds([1.0], [1.0 + 1e-14]), log2_count=4, seed=1)
    assert draws.log_mass == pytest.approx(norm.logpdf(1.0) + np.log(1.0 + 1e-14 - 1.0))


def test_no_coordinate_at_all():
    draws = boxed_draws(np.empty(0), np.empty((0, 0)), Bounds([], []), log2_count=3, seed=1)
    assert draws.points.shape == (8, 0)
    assert draws.log_mass == 0.0
