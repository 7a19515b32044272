"""Residuals of data and prior in one vector."""

import numpy as np
import pytest

from statorhom.identify.inference.problem import FunctionProblem
from statorhom.identify.parameters.parameter_space import Parameter, ParameterSpace

SPACE = ParameterSpace(
    (Parameter("a", 1.0, 0.5, 2.0, 0.01, 100.0), Parameter("b", 1.0, 0.5, 2.0, 0.01, 100.0))
)
MATRIX = np.array([[1.0, 2.0], [3.0, -1.0], [0.5, 0.5]])


def linear(x):
    return MATRIX @ x - 1.0


def test_the_value_is_the_squared_norm_of_data_and_prior():
    problem = FunctionProblem(SPACE, linear)
    x = np.array([0.4, -0.3])
    assert problem(x) == pytest.approx(linear(x) @ linear(x) + x @ x)
    np.testing.assert_allclose(problem.jacobian(x), np.vstack([MATRIX, np.eye(2)]), atol=1e-9)


def test_a_given_derivative_is_used():
    problem = FunctionProblem(SPACE, linear, lambda _: 7.0 * MATRIX)
    np.testing.assert_array_equal(problem.data_jacobian(np.zeros(2)), 7.0 * MATRIX)


@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_where_the_model_does_not_exist_the_value_is_infinite(bad):
    assert FunctionProblem(SPACE, lambda _: np.array([bad, 1.0]))(np.zeros(2)) == np.inf
