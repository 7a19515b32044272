"""All distinct optima of a problem: an ensemble of chains, their starts and ends polished."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from statorhom.errors import IdentificationError, SolverError
from statorhom.identify.inference.polish import Optimum, polish
from statorhom.identify.inference.problem import Problem
from statorhom.identify.optimizers.annealing import SimulatedAnnealing
from statorhom.identify.optimizers.base import Optimizer
from statorhom.identify.optimizers.ensemble import run_ensemble
from statorhom.identify.parameters.bounds import Array
from statorhom.identify.processes.announce import Progress
from statorhom.identify.processes.workers import Tick, Workers

# two optima within this many posterior standard deviations are the same one
SAME = 1.0


def find_optima(
    problem: Problem,
    *,
    seed: int,
    optimizer: Optimizer | None = None,
    chains: int = 4,
    evaluations: int = 4000,
    start: Array | None = None,
    workers: Workers | None = None,
    progress: Progress | None = None,
) -> tuple[Optimum, ...]:
    """Search globally, polish every chain's start and end, and keep what differs, the best first.

    Parameters
    ----------
    problem : Problem
    seed : int
        Equal seeds give equal results, whatever the number of processes.
    optimizer : Optimizer or None
        Simulated annealing unless given.
    chains, evaluations : int
        Number of chains, and evaluations of all of them together (the polish adds some
        dozens per coordinate and chain).
    start : array, shape (d,), or None
        Start of the first chain (default: prior mean); the others start from draws of the prior.
    workers : Workers or None
        Processes; inline where None.
    progress : callable or None
        Called with the evaluations spent by the chains so far.

    Raises
    ------
    IdentificationError
        Where no chain meets a point at which the model exists, or the budget is too small.
    """
    space = problem.space
    first = space.start if start is None else space.bounds.clip(np.asarray(start, float))
    workers = Workers() if workers is None else workers
    if space.dimension == 0:
        return (polish(problem, first),)
    # a stream of its own, so that starts and moves are independent
    rng = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(2**31,)))
    starts = np.vstack([first, space.sample(chains - 1, rng)]) if chains > 1 else first[None, :][:chains]
    results = run_ensemble(
        optimizer or SimulatedAnnealing(),
        problem,
        space.bounds,
        starts,
        evaluations=evaluations,
        seed=seed,
        workers=workers,
        progress=progress,
    )
    # the starts as well: least squares from draws of the prior meets optima that cooling walks past
    tasks = [(problem, x) for x in (*(result.x for result in results), *starts)]
    found = [optimum for optimum in workers.map(_polish_task, tasks) if optimum is not None]
    if not found:
        raise IdentificationError(
            "no chain found values for which the model exists: change priors or fixed constants"
        )
    return distinct_optima(found)


def distinct_optima(optima: Iterable[Optimum]) -> tuple[Optimum, ...]:
    """Return the optima that lie more than a posterior standard deviation apart, the best first."""
    kept: list[Optimum] = []
    for optimum in sorted(optima, key=lambda candidate: candidate.value):
        if not any(_same(optimum, better) for better in kept):
            kept.append(optimum)
    return tuple(kept)


def _same(a: Optimum, b: Optimum) -> bool:
    # by the flatter of the two, since a kink may lie between them
    difference = a.x - b.x
    return min(float(np.linalg.norm(o.jacobian @ difference)) for o in (a, b)) < SAME


def _polish_task(task: tuple[Problem, Array], tick: Tick) -> Optimum | None:
    tick()
    try:
        return polish(*task)
    except (IdentificationError, SolverError):
        # the model does not exist here; other ends of chains may do better
        return None
