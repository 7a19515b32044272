"""What draws stand for, against integrals that are known otherwise: Gaussians, two valleys, limits."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from scipy.special import logsumexp
from scipy.stats import multivariate_normal, norm

from statorhom.diagnose.fits.importance import ALL_OVER, EFFECTIVE, NEARBY, Box, Draws, draws_of

WIDE_OPEN = np.full(2, 8.0)


def box(*, is_normal: bool = True, high: float = 8.0) -> Box:
    return Box(-WIDE_OPEN, np.array([high, 8.0]), np.full(2, is_normal))


def drawn(likelihood: Callable[..., Any], prior: Box, middle: np.ndarray, covariance: np.ndarray) -> Draws:
    return draws_of(likelihood, prior, middle, covariance, np.random.default_rng(0))


def log_integral(found: Draws) -> float:
    return float(logsumexp(found.log_weights) - np.log(len(found.log_weights)))


def test_a_gaussian_under_a_normal_prior() -> None:
    """Laplace's is exact there: N(m; 0, 1 + s²)."""
    middle, noise = np.array([1.0, -0.5]), np.array([[0.09, 0.05], [0.05, 0.16]])
    likelihood = multivariate_normal(middle, noise)
    exact = multivariate_normal(np.zeros(2), noise + np.eye(2)).logpdf(middle)
    posterior = np.linalg.inv(np.linalg.inv(noise) + np.eye(2))
    found = drawn(likelihood.logpdf, box(), posterior @ np.linalg.solve(noise, middle), posterior)
    assert log_integral(found) == pytest.approx(exact, abs=0.1)
    assert found.effective > EFFECTIVE


def test_a_valley_that_no_refit_has_seen_is_counted() -> None:
    known, other, noise = np.array([1.5, 0.0]), np.array([-2.0, 1.0]), 0.2 * np.eye(2)

    def likelihood(point: np.ndarray) -> float:
        shallow = multivariate_normal(known, noise).logpdf(point)
        return float(np.logaddexp(shallow, 3.0 + multivariate_normal(other, noise).logpdf(point)))

    prior = Box(np.full(2, -3.5), np.full(2, 3.5), np.full(2, False))
    found = drawn(likelihood, prior, known, noise)
    assert log_integral(found) == pytest.approx(np.log(1 + np.exp(3.0)) - np.log(7.0**2), abs=0.2)
    best = found.points[np.argmax(found.log_likelihoods)]
    assert np.linalg.norm(best - other) < 0.5


@pytest.mark.parametrize("high", [0.0, 0.5])
def test_what_lies_beyond_a_limit_does_not_count(high: float) -> None:
    """And a prior is one within its limits."""
    noise = np.diag([0.5, 0.1])
    likelihood = multivariate_normal(np.zeros(2), noise)
    posterior = np.diag([1 / (1 + 1 / 0.5), 1 / (1 + 1 / 0.1)])
    whole = multivariate_normal(np.zeros(2), noise + np.eye(2)).logpdf(np.zeros(2))
    part = norm.logcdf(high / np.sqrt(posterior[0, 0])) - norm.logcdf(high)
    found = drawn(likelihood.logpdf, box(high=high), np.zeros(2), posterior)
    assert log_integral(found) == pytest.approx(whole + part, abs=0.1)


def test_data_that_tell_nothing_leave_the_prior() -> None:
    for prior in (box(), box(is_normal=False), Box(-WIDE_OPEN, WIDE_OPEN, np.array([True, False]))):
        found = drawn(lambda _: -3.0, prior, np.zeros(2), np.eye(2))
        assert log_integral(found) == pytest.approx(-3.0, abs=0.1)


def test_the_same_draws_give_the_same() -> None:
    found = [drawn(lambda p: -float(p @ p), box(), np.zeros(2), np.eye(2)) for _ in range(2)]
    np.testing.assert_array_equal(found[0].points, found[1].points)


def test_where_nothing_is_possible_there_is_nowhere_to_draw() -> None:
    found = drawn(lambda _: -np.inf, box(), np.zeros(2), np.eye(2))
    assert found.are_impossible
    assert len(found.points) == NEARBY + ALL_OVER
