"""NSGA-II over a cube, one objective per mode, by pymoo (Deb, Pratap, Agarwal and Meyarivan, IEEE Trans. 6, 2002)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from statorhom.identify.parameters.bounds import Array, read_only
from statorhom.identify.surface.optional import optional

POPULATION = 100


@dataclass(frozen=True, eq=False)
class ParetoFront:
    """Points of which none is better than another in all objectives.

    Parameters
    ----------
    points : (k, d) in the cube [−1, 1]^d.
    objectives : (k, m).
    evaluations : of the objectives, all together.
    """

    points: Array
    objectives: Array
    evaluations: int


def pareto_front(
    objectives: Callable[[Array], Array], dimension: int, count: int, *, evaluations: int, seed: int
) -> ParetoFront:
    """Minimize several objectives at once.

    Parameters
    ----------
    objectives : takes (n, d), returns (n, m).
    dimension : d.
    count : m.
    evaluations : at about which number of points it stops.
    seed : equal seeds give equal fronts.

    Raises
    ------
    MissingDependencyError
        If pymoo is not installed.
    """
    core = optional("pymoo.core.problem", "pymoo", "NSGA-II")
    algorithm = optional("pymoo.algorithms.moo.nsga2", "pymoo", "NSGA-II")
    optimize = optional("pymoo.optimize", "pymoo", "NSGA-II")
    evaluated = 0

    def evaluate(points: Array) -> Array:
        nonlocal evaluated
        evaluated += len(points)
        return objectives(points)

    problem = _problem(core.Problem, evaluate, dimension, count)
    size = min(POPULATION, max(20, evaluations // 10))
    state = np.random.get_state()  # the library seeds the global generator; it is put back
    try:
        found = optimize.minimize(
            problem, algorithm.NSGA2(pop_size=size), ("n_eval", evaluations), seed=seed, verbose=False
        )
    finally:
        np.random.set_state(state)
    return ParetoFront(read_only(np.atleast_2d(found.X)), read_only(np.atleast_2d(found.F)), evaluated)


def _problem(base: type, evaluate: Callable[[Array], Array], dimension: int, count: int) -> object:
    class FrequencyErrors(base):
        def __init__(self) -> None:
            super().__init__(n_var=dimension, n_obj=count, xl=-np.ones(dimension), xu=np.ones(dimension))

        def _evaluate(self, x: Array, out: dict[str, Array], *_args: object, **_kwargs: object) -> None:
            out["F"] = evaluate(x)

    return FrequencyErrors()
