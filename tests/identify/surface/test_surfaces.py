"""Polynomials and Gaussian processes as response surfaces, and NSGA-II on known fronts."""

import numpy as np
import pytest

from statorhom.errors import IdentificationError
from statorhom.identify.surface.design import full_factorial, latin_hypercube_of
from statorhom.identify.surface.gaussian_process import fit_gaussian_process
from statorhom.identify.surface.nsga2 import pareto_front
from statorhom.identify.surface.polynomial import coefficient_count, fit_polynomial

POINTS = latin_hypercube_of(2, 24, 3)
OTHERS = latin_hypercube_of(2, 30, 4)


def cubic(points):
    x, y = points.T
    return np.stack([1 + x - 2 * x * y**2 + y**3, 4 - y], axis=1)


def two_springs(points):
    """ln f of two masses whose springs vary by a factor of e² each."""
    a, b = np.exp(points.T)
    half, root = a + b / 2, np.sqrt(a**2 + b**2 / 4)
    return 0.5 * np.log(np.stack([half - 0.7 * root, half + 0.7 * root], axis=1))


def test_a_polynomial_of_its_own_degree_is_met_exactly():
    surface = fit_polynomial(POINTS, cubic(POINTS), 3)
    np.testing.assert_allclose(surface(OTHERS), cubic(OTHERS), atol=1e-12)
    assert surface.description == "polynomial of degree 3, 10 coefficients"


def test_the_degree_is_chosen_by_what_it_predicts():
    noisy = cubic(POINTS) + 1e-3 * np.random.default_rng(1).standard_normal((24, 2))
    assert fit_polynomial(POINTS, noisy).degree == 3


def test_coefficients_are_counted():
    assert [coefficient_count(2, p) for p in (1, 2, 3)] == [3, 6, 10]
    assert coefficient_count(5, 3) == 56


def test_a_design_with_fewer_points_than_coefficients_is_refused():
    with pytest.raises(IdentificationError) as caught:
        fit_polynomial(POINTS[:9], cubic(POINTS[:9]), 3)
    assert "a design of 9 points cannot determine the 10 coefficients" in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_design_with_too_few_levels_is_refused():
    points = full_factorial(2, 0)
    with pytest.raises(IdentificationError, match="only 8 of the 10 coefficients"):
        fit_polynomial(np.vstack([points, points]), cubic(np.vstack([points, points])), 3)


@pytest.mark.parametrize("fit", [fit_polynomial, fit_gaussian_process])
def test_smooth_frequencies_are_predicted(fit):
    surface = fit(POINTS, two_springs(POINTS))
    assert np.abs(surface(OTHERS) - two_springs(OTHERS)).max() < 0.01


def test_a_gaussian_process_meets_its_points():
    surface = fit_gaussian_process(POINTS, two_springs(POINTS))
    np.testing.assert_allclose(surface(POINTS), two_springs(POINTS), atol=1e-4)
    assert surface.description == "Gaussian process on 24 points"


def schaffer(points):
    """Schaffer's problem: the front is x in [0, 2] / 4 of the cube, f2 = (√f1 − 2)²."""
    x = 4.0 * points[:, 0]
    return np.stack([x**2, (x - 2.0) ** 2], axis=1)


def test_the_front_of_schaffer_s_problem():
    front = pareto_front(schaffer, 1, 2, evaluations=1500, seed=2)
    x = 4.0 * front.points[:, 0]
    assert -0.05 <= x.min() < 0.1 and 1.9 < x.max() <= 2.05
    expected = (np.sqrt(front.objectives[:, 0]) - 2.0) ** 2
    np.testing.assert_allclose(front.objectives[:, 1], expected, atol=0.2)
    assert abs(front.evaluations - 1500) <= 100


def test_the_front_depends_on_the_seed_alone_and_leaves_the_global_generator():
    np.random.seed(11)
    expected = np.random.random(3)
    np.random.seed(11)
    first = pareto_front(schaffer, 1, 2, evaluations=200, seed=2)
    np.testing.assert_array_equal(np.random.random(3), expected)
    again = pareto_front(schaffer, 1, 2, evaluations=200, seed=2)
    np.testing.assert_array_equal(first.points, again.points)
