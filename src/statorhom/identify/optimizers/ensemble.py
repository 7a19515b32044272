"""Several chains from different starts, each with its own stream of random numbers."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from statorhom.errors import IdentificationError
from statorhom.identify.optimizers.base import Objective, Optimizer, OptimizerResult
from statorhom.identify.parameters.bounds import Array, Bounds
from statorhom.identify.processes.announce import Progress
from statorhom.identify.processes.workers import Tick, Workers


@dataclass(frozen=True, eq=False)
class _ChainTask:
    optimizer: Optimizer
    objective: Objective
    bounds: Bounds
    start: Array
    evaluations: int
    seed: np.random.SeedSequence


def run_ensemble(
    optimizer: Optimizer,
    objective: Objective,
    bounds: Bounds,
    starts: Array,
    *,
    evaluations: int,
    seed: int,
    workers: Workers,
    progress: Progress | None = None,
) -> tuple[OptimizerResult, ...]:
    """Run one chain from every start.

    Parameters
    ----------
    optimizer : Optimizer
    objective : callable
        Picklable where `workers` has more than one job.
    bounds : Bounds
    starts : array, shape (chains, d)
    evaluations : int
        Of all chains together.
    seed : int
        The chains' seeds are its children, so they do not depend on the number of processes.
    workers : Workers
    progress : callable or None
        Called with the number of evaluations so far.

    Returns
    -------
    tuple of OptimizerResult, in the order of the starts

    Raises
    ------
    IdentificationError
        No start, or too few evaluations per chain.
    """
    if len(starts) == 0:
        raise IdentificationError("0 chains: raise identify.chains to at least 1")
    seeds = np.random.SeedSequence(seed).spawn(len(starts))
    share = evaluations // len(starts)
    tasks = [
        _ChainTask(optimizer, objective, bounds, start, share, child)
        for start, child in zip(starts, seeds, strict=True)
    ]
    return tuple(workers.map(_run_chain, tasks, progress=progress))


def _run_chain(task: _ChainTask, tick: Tick) -> OptimizerResult:
    return task.optimizer.minimize(
        task.objective,
        task.bounds,
        task.start,
        evaluations=task.evaluations,
        seed=task.seed,
        callback=lambda _count, _best: tick(),
    )
