"""Evidence against exact and numerical integrals."""

import numpy as np
import pytest
from scipy.stats import multivariate_normal

from statorhom.identify.inference.laplace import laplace
from statorhom.identify.inference.polish import polish
from statorhom.identify.inference.problem import FunctionProblem
from statorhom.identify.parameters.parameter_space import Parameter, ParameterSpace
from statorhom.identify.parameters.prior_block import PriorBlock

MATRIX = np.array([[3.0, 1.0], [1.0, -2.0], [0.3, 1.0]])
DATA = np.array([1.0, 2.0, -1.0])


def space(upper=1e12, blocks=()):
    return ParameterSpace(
        tuple(Parameter(name, 1.0, 0.5, 2.0, 1e-12, upper) for name in ("a", "b")), blocks=blocks
    )


@pytest.mark.parametrize(
    "blocks",
    [(), (PriorBlock(("a", "b"), [0.5, -0.2], [[0.3, 0.1], [0.1, 0.2]]),)],
    ids=["independent", "block"],
)
def test_the_evidence_of_a_linear_model_is_exact(blocks):
    where = space(blocks=blocks)
    approximation = laplace(polish(FunctionProblem(where, lambda x: MATRIX @ x - DATA), np.zeros(2)), where)
    exact = multivariate_normal(
        MATRIX @ where.prior_mean, np.eye(3) + MATRIX @ where.prior_covariance @ MATRIX.T
    ).logpdf(DATA)
    # the problem's likelihood leaves out the constant of three standardised numbers
    assert approximation.log_evidence - 1.5 * np.log(2 * np.pi) == pytest.approx(exact, abs=1e-6)
    precision = MATRIX.T @ MATRIX + np.linalg.inv(where.prior_covariance)
    np.testing.assert_allclose(approximation.covariance, np.linalg.inv(precision), atol=1e-7)


def test_limits_count_in_prior_and_posterior():
    where = space(upper=1.1)
    approximation = laplace(
        polish(FunctionProblem(where, lambda x: MATRIX @ x - DATA - 2.0), np.zeros(2)), where
    )
    assert approximation.optimum.at_limit.any()
    axis = np.linspace(-8.0, where.bounds.upper[0], 1601)
    grid = np.stack(np.meshgrid(axis, axis, indexing="ij"), axis=-1)
    prior = np.exp(-0.5 * np.sum(grid**2, axis=-1))
    likelihood = np.exp(-0.5 * np.sum((grid @ MATRIX.T - DATA - 2.0) ** 2, axis=-1))
    edge = np.ones(axis.size)
    edge[[0, -1]] = 0.5
    expected = np.log(edge @ (prior * likelihood) @ edge / (edge @ prior @ edge))
    assert approximation.log_evidence == pytest.approx(expected, abs=0.01)
    density = prior * likelihood * np.outer(edge, edge)
    mean = np.tensordot(density / density.sum(), grid, axes=2)
    np.testing.assert_allclose(approximation.draws.weights @ approximation.draws.points, mean, atol=0.01)


def test_the_constant_of_the_data_is_added():
    class Scaled(FunctionProblem):
        @property
        def log_normalization(self):
            return 12.5

    plain, scaled = (
        laplace(polish(kind(space(), lambda x: MATRIX @ x - DATA), np.zeros(2)), space())
        for kind in (FunctionProblem, Scaled)
    )
    assert scaled.log_evidence - plain.log_evidence == pytest.approx(12.5)
