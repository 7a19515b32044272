"""Simulated annealing: simanneal's cooling and acceptance, made safe.

What simanneal 0.5 does to its host, and what stands here instead: it draws from the global
`random` (its loop runs with a private generator); its constructor replaces the handler of SIGINT
and therefore fails outside the main thread (never called); it accepts NaN as an improvement (the
recorder turns NaN into infinity); it prints to standard error (switched off); its `auto` never
ends on a plateau (the temperatures come from own samples); it knows no bounds (moves reflect).
"""

from __future__ import annotations

from dataclasses import dataclass
from types import FunctionType, SimpleNamespace

import numpy as np
from simanneal import Annealer

from statorhom.identify.optimizers.base import Callback, Objective, OptimizerResult, Recorder, Seed
from statorhom.identify.optimizers.proposal import Proposal
from statorhom.identify.optimizers.temperature import end_temperature, sampled_rises, start_temperature
from statorhom.identify.parameters.bounds import Array, Bounds


@dataclass(frozen=True)
class SimulatedAnnealing:
    """Exponential cooling with Metropolis' rule (Kirkpatrick, Gelatt and Vecchi, Science 220, 1983).

    Parameters
    ----------
    initial_acceptance : float
        Share of uphill moves accepted at the start, in (0, 1).
    """

    initial_acceptance: float = 0.5

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
        """Minimize `objective`; see `Optimizer.minimize`."""
        rng = np.random.default_rng(seed)
        start = bounds.clip(np.array(start, dtype=float))
        evaluate = Recorder(objective, start, evaluations, callback)
        proposal = Proposal(bounds, rng)
        rises = sampled_rises(evaluate, proposal, start)
        hot = start_temperature(rises, self.initial_acceptance)
        chain = _Chain(evaluate.best_x, evaluate, proposal, hot)
        _anneal_with(rng)(chain)
        return evaluate.result()


class _Chain(Annealer):
    """The hooks that simanneal calls: state, move and energy."""

    copy_strategy = "method"
    updates = 0

    def __init__(self, start: Array, evaluate: Recorder, proposal: Proposal, hot: float) -> None:
        # deliberately without super().__init__(), which would take over SIGINT
        self.state = start.copy()
        self.Tmax, self.Tmin = hot, end_temperature(hot)
        # the loop evaluates its start once more before the first step
        self.steps = evaluate.remaining - 1
        self._evaluate = evaluate
        self._proposal = proposal
        self._proposed: Array | None = None

    def move(self) -> None:
        # a rejected state is replaced by a copy of the one before: identity tells what happened
        if self._proposed is not None:
            self._proposal.feedback(self.state is self._proposed)
        self.state = self._proposed = self._proposal.propose(self.state)

    def energy(self) -> float:
        return self._evaluate(self.state)


def _anneal_with(rng: np.random.Generator) -> FunctionType:
    """Return simanneal's loop bound to `rng` in place of the module `random`."""
    loop = Annealer.anneal
    return FunctionType(loop.__code__, {**loop.__globals__, "random": SimpleNamespace(random=rng.random)})
