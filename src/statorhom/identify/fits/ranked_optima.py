"""Optima of a problem whose measured modes have no names, found by descending in two scales.

Where no label says which mode is which, cooling walks among decades of stiffness in which the nearest simulated mode
is never far: the cost is rough and nearly flat. The ranks of the modes tell more there: the k-th measured mode is about
the k-th simulated one, so that a least-squares descent from anywhere finds the right scale and the right ratios. From
there the nearest partners, which may cross each other, decide.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from statorhom.errors import IdentificationError, SolverError
from statorhom.identify.inference.optima import distinct_optima
from statorhom.identify.inference.polish import Optimum, polish
from statorhom.identify.processes.workers import Tick, Workers
from statorhom.identify.residuals.stage_problem import StageProblem

STARTS = 24  # draws of the prior, its mean first
KEPT = 8  # of what they lead to, by the cost with the nearest partners
RANKED_SD = 0.1  # of ln f: two modes that change places, or one that was not found


def ranked_optima(problem: StageProblem, *, seed: int, workers: Workers) -> tuple[Optimum, ...]:
    """Local optima of a coarse problem, the best first; none where no descent succeeds.

    Parameters
    ----------
    problem : with the tolerance of the pairing.
    seed : of the starts.
    workers : processes.
    """
    space = problem.space
    if space.dimension == 0:
        return ()
    rng = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(2**31 + 1,)))
    starts = np.vstack([space.start, space.sample(STARTS - 1, rng)])
    ranked = replace(problem, by_rank=True, discrepancy=RANKED_SD)
    found = [x for x in workers.map(_descend, [(ranked, x) for x in starts]) if x is not None]
    costs = workers.map(_cost, [(problem, o.x) for o in found])
    best = [found[i].x for i in np.argsort(costs, kind="stable")[:KEPT]]
    polished = workers.map(_descend, [(problem, x) for x in best])
    return distinct_optima([optimum for optimum in polished if optimum is not None])


def _descend(task: tuple[StageProblem, np.ndarray], tick: Tick) -> Optimum | None:
    tick()
    try:
        return polish(*task)
    except (IdentificationError, SolverError):
        return None  # the model does not exist there; other starts may do better


def _cost(task: tuple[StageProblem, np.ndarray], tick: Tick) -> float:
    problem, x = task
    tick()
    return float(problem(x))
