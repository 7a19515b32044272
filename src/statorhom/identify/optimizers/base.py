"""The interface of global optimizers and the bookkeeping they share."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from statorhom.errors import IdentificationError
from statorhom.identify.parameters.bounds import Array, Bounds, read_only

Objective = Callable[[Array], float]
Callback = Callable[[int, float], None]
Seed = int | np.random.SeedSequence

MIN_EVALUATIONS = 50


@dataclass(frozen=True, eq=False)
class OptimizerResult:
    """The best point of one run.

    Parameters
    ----------
    x : array, shape (d,)
    value : float
    evaluations : int
        Evaluations spent, temperature estimate included.
    history : array, shape (k, 2)
        Number of the evaluation and value at every improvement.
    """

    x: Array
    value: float
    evaluations: int
    history: Array


class Optimizer(Protocol):
    """A derivative-free global minimizer inside a box."""

    def minimize(
        self,
        objective: Objective,
        bounds: Bounds,
        start: Array,
        *,
        evaluations: int,
        seed: Seed,
        callback: Callback | None = None,
    ) -> OptimizerResult:
        """Minimize `objective` from `start` with exactly `evaluations` calls.

        Parameters
        ----------
        objective : callable
            Maps shape (d,) to a number; non-finite values are never accepted.
        bounds : Bounds
            Never left.
        start : array, shape (d,)
        evaluations : int
            At least `MIN_EVALUATIONS`.
        seed : int or SeedSequence
            Equal seeds give equal results.
        callback : callable or None
            Called after every evaluation with their number and the best value so far; an exception
            that it raises ends the run.

        Raises
        ------
        IdentificationError
            Too few evaluations.
        """
        ...


class Recorder:
    """Counts evaluations of an objective and remembers the best of them."""

    def __init__(
        self, objective: Objective, start: Array, evaluations: int, callback: Callback | None
    ) -> None:
        if evaluations < MIN_EVALUATIONS:
            raise IdentificationError(
                f"{evaluations} evaluations per chain are too few: raise identify.evaluations so that each "
                f"chain has {MIN_EVALUATIONS}"
            )
        self.budget = evaluations
        self.count = 0
        self.best_x = start
        self.best_value = float("inf")
        self._objective = objective
        self._callback = callback
        self._history: list[tuple[float, float]] = []

    @property
    def remaining(self) -> int:
        """Evaluations that are left."""
        return self.budget - self.count

    def __call__(self, x: Array) -> float:
        """Evaluate; what is not a number counts as infinite, because NaN passes every comparison."""
        value = float(self._objective(x.copy()))
        value = float("inf") if np.isnan(value) else value
        self.count += 1
        if value < self.best_value:
            self.best_x, self.best_value = x.copy(), value
            self._history.append((self.count, value))
        if self._callback is not None:
            self._callback(self.count, self.best_value)
        return value

    def result(self) -> OptimizerResult:
        """Return what was found."""
        history = read_only(np.array(self._history, dtype=float).reshape(-1, 2))
        return OptimizerResult(read_only(self.best_x), self.best_value, self.count, history)
