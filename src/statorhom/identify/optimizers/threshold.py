"""Threshold accepting (Dueck and Scheuer, J. Comput. Phys. 90, 1990)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from statorhom.identify.optimizers.base import Callback, Objective, OptimizerResult, Recorder, Seed
from statorhom.identify.optimizers.proposal import Proposal
from statorhom.identify.optimizers.temperature import end_temperature, sampled_rises, start_temperature
from statorhom.identify.parameters.bounds import Array, Bounds


@dataclass(frozen=True)
class ThresholdAccepting:
    """Accepts every move whose rise stays below a falling threshold; no chance is involved in that.

    Parameters
    ----------
    initial_acceptance : float
        Sets the first threshold to the temperature at which annealing accepts this share.
    greedy_share : float
        Last part of the run, in which only improvements pass.
    """

    initial_acceptance: float = 0.5
    greedy_share: float = 0.1

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
        start = bounds.clip(np.array(start, dtype=float))
        evaluate = Recorder(objective, start, evaluations, callback)
        proposal = Proposal(bounds, np.random.default_rng(seed))
        rises = sampled_rises(evaluate, proposal, start)
        thresholds = self._thresholds(start_temperature(rises, self.initial_acceptance), evaluate.remaining)
        _descend(evaluate, proposal, thresholds)
        return evaluate.result()

    def _thresholds(self, first: float, count: int) -> Array:
        thresholds = np.geomspace(first, end_temperature(first), count)
        thresholds[count - int(self.greedy_share * count) :] = 0.0
        return thresholds


def _descend(evaluate: Recorder, proposal: Proposal, thresholds: Array) -> None:
    x, value = evaluate.best_x, evaluate.best_value
    for threshold in thresholds:
        candidate = proposal.propose(x)
        energy = evaluate(candidate)
        accepted = energy <= value + threshold
        proposal.feedback(accepted)
        if accepted:
            x, value = candidate, energy
