"""Bounded least squares to the local optimum."""

from dataclasses import dataclass
from types import SimpleNamespace
from unittest.mock import MagicMock

import numpy as np
import pytest

from statorhom.errors import IdentificationError
from statorhom.identify.inference.polish import _towards, polish
from statorhom.identify.inference.problem import FunctionProblem, Problem
from statorhom.identify.parameters.parameter_space import Parameter, ParameterSpace


def space(*names, lower=1e-9, upper=1e9):
    return ParameterSpace(tuple(Parameter(name, 1.0, 0.5, 2.0, lower, upper) for name in names))


def test_a_linear_problem_is_solved_exactly():
    matrix = np.array([[3.0, 1.0], [1.0, -2.0], [0.3, 5.0]])
    problem = FunctionProblem(space("a", "b"), lambda x: matrix @ x - np.array([1.0, 2.0, 3.0]))
    optimum = polish(problem, np.array([3.0, -3.0]))
    exact = np.linalg.solve(matrix.T @ matrix + np.eye(2), matrix.T @ [1.0, 2.0, 3.0])
    np.testing.assert_allclose(optimum.x, exact, atol=1e-7)
    assert optimum.converged
    assert optimum.value == pytest.approx(problem(exact))
    assert optimum.data_value == pytest.approx(optimum.value - exact @ exact)
    np.testing.assert_allclose(optimum.jacobian, np.vstack([matrix, np.eye(2)]), atol=1e-8)
    assert not optimum.at_limit.any()


def test_an_analytic_derivative_saves_the_differences():
    calls = []

    def residuals(x):
        calls.append(1)
        return np.array([10.0 * (x[1] - x[0] ** 2), 3.0 * (1.0 - x[0])])

    def derivative(x):
        return np.array([[-20.0 * x[0], 10.0], [-3.0, 0.0]])

    by_differences = polish(FunctionProblem(space("a", "b"), residuals), np.zeros(2))
    spent = len(calls)
    calls.clear()
    by_formula = polish(FunctionProblem(space("a", "b"), residuals, derivative), np.zeros(2))
    np.testing.assert_allclose(by_formula.x, by_differences.x, atol=1e-6)
    assert len(calls) < spent / 2


def test_a_limit_is_reached_and_reported():
    problem = FunctionProblem(space("a", "b", upper=2.0), lambda x: 10.0 * (x - np.array([5.0, 0.2])))
    optimum = polish(problem, np.zeros(2))
    assert optimum.x[0] == problem.space.bounds.upper[0]
    assert list(optimum.at_limit) == [True, False]
    assert optimum.x[1] == pytest.approx(0.2 * 100 / 101, abs=1e-6)


def test_rounding_leads_past_no_limit():
    """0.3 + (0.9 - 0.3) is more than 0.9: a step to a limit is clipped again."""
    bounds = SimpleNamespace(clip=lambda x: np.minimum(x, 0.9))
    falling = MagicMock(side_effect=lambda x: float(-x[0]), space=SimpleNamespace(bounds=bounds))
    x, gain = _towards(falling, np.array([0.3]), -0.3, np.array([0.9]))
    assert 0.3 + (0.9 - 0.3) > 0.9
    assert x[0] == 0.9
    assert gain > 0


@dataclass(frozen=True, eq=False)
class Pairing(Problem):
    """Two measured numbers, each taken for the nearer of two branches; `held` fixes the choice."""

    space: ParameterSpace
    held: tuple[int, ...] | None = None

    def branches(self, x):
        return np.array([[1.0 + 2.0 * x[0], 4.0 - x[0]], [3.0 * x[0], 2.0 - 2.0 * x[0]]]) - [[3.0], [3.0]]

    def choice(self, x):
        return tuple(np.argmin(np.abs(self.branches(x)), axis=1))

    def data_residuals(self, x):
        held = self.choice(x) if self.held is None else self.held
        return 20.0 * self.branches(x)[[0, 1], held]

    def smooth_at(self, x):
        return Pairing(self.space, self.choice(x))


@pytest.mark.parametrize("start", np.linspace(-3, 3, 13))
def test_discrete_choices_may_change_on_the_way_and_the_end_is_a_true_optimum(start):
    problem = Pairing(space("a"))
    optimum = polish(problem, np.array([start]))
    near = optimum.x + np.linspace(-1e-3, 1e-3, 21)[:, None]
    assert min(problem(x) for x in near) >= optimum.value - 1e-6
    assert optimum.value <= problem(np.array([start]))


def test_where_the_model_does_not_exist_at_the_start_it_is_said():
    with pytest.raises(IdentificationError, match="does not exist at the starting values"):
        polish(FunctionProblem(space("a"), lambda _: np.array([np.nan])), np.zeros(1))


def test_a_forbidden_region_is_avoided():
    problem = FunctionProblem(space("a"), lambda x: 3.0 * (x - 1.0) if x[0] < 1.2 else np.full(1, np.nan))
    assert polish(problem, np.array([-4.0])).x[0] == pytest.approx(0.9, abs=1e-6)
