"""Start and end of a cooling schedule, from samples of the objective."""

from __future__ import annotations

import numpy as np

from statorhom.identify.optimizers.base import Recorder
from statorhom.identify.optimizers.proposal import Proposal
from statorhom.identify.parameters.bounds import Array

SAMPLING_SHARE = 0.1
FEWEST_SAMPLES, MOST_SAMPLES = 20, 100
# with an objective that is −2 ln posterior, a temperature of 2 samples the posterior itself
FINAL_TEMPERATURE = 0.2
SMALLEST_FALL = 1e-3


def sampled_rises(evaluate: Recorder, proposal: Proposal, start: Array) -> Array:
    """Walk at random from `start`, accepting everything, and return the rises of the objective.

    Spends a tenth of the budget (20 to 100 evaluations); the best point is kept by the recorder.
    """
    count = int(np.clip(SAMPLING_SHARE * evaluate.budget, FEWEST_SAMPLES, MOST_SAMPLES))
    x, energies = start, np.empty(count)
    for k in range(count):
        energies[k] = evaluate(x)
        x = proposal.propose(x)
    rises = np.diff(energies[np.isfinite(energies)])
    return np.abs(rises[rises != 0.0])


def start_temperature(rises: Array, acceptance: float) -> float:
    """Return the temperature at which the mean of exp(−rise/T) equals `acceptance`.

    The criterion is that of Ben-Ameur (Comput. Optim. Appl. 29, 2004); bisection in ln T solves it.
    """
    if rises.size == 0:
        return 1.0
    low, high = np.log(rises.min()) - 20.0, np.log(rises.max()) + 20.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        # exponents beyond 700 underflow to nothing
        rate = float(np.mean(np.exp(-np.minimum(rises * np.exp(-middle), 700.0))))
        low, high = (middle, high) if rate < acceptance else (low, middle)
    return float(np.exp(high))


def end_temperature(start: float) -> float:
    """Return a temperature below the noise of the data, and far below the start whatever the scale."""
    return min(FINAL_TEMPERATURE, SMALLEST_FALL * start)
