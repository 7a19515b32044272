"""Global search: all optima of a multimodal problem, reproducibly."""

import numpy as np
import pytest

from statorhom.errors import IdentificationError
from statorhom.identify.inference.optima import distinct_optima, find_optima
from statorhom.identify.inference.polish import polish
from statorhom.identify.inference.problem import FunctionProblem
from statorhom.identify.optimizers.threshold import ThresholdAccepting
from statorhom.identify.parameters.parameter_space import Parameter, ParameterSpace
from statorhom.identify.processes.workers import Workers

NAMES = ("a", "b", "c", "d")
SPACE = ParameterSpace(tuple(Parameter(name, 1.0, 0.5, 2.0, 0.05, 20.0) for name in NAMES))


def absorber(x):
    """One frequency met by several values of `a`, a bent valley in `b`, and a stiff pair."""
    return (
        np.array(
            [
                3.0 * np.sin(2.5 * x[0]) + 0.5 * x[0] - 1.0,
                10.0 * (x[1] - x[0] ** 2),
                9.0 * (x[2] + x[3]),
                x[2] - x[3],
            ]
        )
        / 0.05
    )


def global_minimum():
    problem = FunctionProblem(SPACE, absorber)
    starts = (np.array([a, a**2, 0.0, 0.0]) for a in np.linspace(-2.5, 2.5, 40))
    return min((polish(problem, start) for start in starts), key=lambda optimum: optimum.value)


@pytest.mark.parametrize("optimizer", [None, ThresholdAccepting()], ids=["annealing", "threshold"])
def test_the_global_optimum_of_a_multimodal_problem_is_found(optimizer):
    problem = FunctionProblem(SPACE, absorber)
    best = global_minimum()
    for seed in range(3):
        optima = find_optima(problem, seed=seed, optimizer=optimizer)
        assert optima[0].value == pytest.approx(best.value, rel=1e-6)
        assert len(optima) >= 2
        assert [o.value for o in optima] == sorted(o.value for o in optima)


def test_processes_and_inline_give_the_same_bits():
    problem = FunctionProblem(SPACE, absorber)
    inline = find_optima(problem, seed=5, evaluations=400)
    with Workers(2) as workers:
        parallel = find_optima(problem, seed=5, evaluations=400, workers=workers)
    assert len(inline) == len(parallel)
    for a, b in zip(inline, parallel, strict=True):
        np.testing.assert_array_equal(a.x, b.x)
        np.testing.assert_array_equal(a.jacobian, b.jacobian)


def test_equal_optima_are_kept_once():
    problem = FunctionProblem(SPACE, lambda x: 100.0 * (x - 0.1))
    twice = [polish(problem, start) for start in (np.zeros(4), np.full(4, 1.5))]
    assert len(distinct_optima(twice)) == 1


def test_a_region_without_a_model_is_walked_around():
    problem = FunctionProblem(SPACE, lambda x: absorber(x) if x[1] > -0.5 else np.full(4, np.nan))
    optima = find_optima(problem, seed=1, evaluations=2000, start=np.array([0.0, -1.0, 0.0, 0.0]))
    assert optima[0].value == pytest.approx(global_minimum().value, rel=1e-6)


def test_nothing_to_vary():
    problem = FunctionProblem(ParameterSpace((Parameter.constant("a", 2.0),)), lambda _: np.array([1.0, 2.0]))
    (optimum,) = find_optima(problem, seed=1)
    assert optimum.value == 5.0
    assert optimum.converged


def test_a_model_that_never_exists_and_too_small_budgets_are_said():
    nowhere = FunctionProblem(SPACE, lambda _: np.full(4, np.nan))
    with pytest.raises(IdentificationError, match="no chain found values"):
        find_optima(nowhere, seed=1, evaluations=200)
    with pytest.raises(IdentificationError, match=r"raise identify\.evaluations"):
        find_optima(nowhere, seed=1, evaluations=100)
    with pytest.raises(IdentificationError, match=r"identify\.chains"):
        find_optima(nowhere, seed=1, chains=0)
