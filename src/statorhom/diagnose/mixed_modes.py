"""What modes that are mixed with others say less: a charge that grows as an effect brings modes together."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]
# usual relative standard deviation of a predicted mode, beside which one that is mixed is charged
SHARP = 1e-3


def mixed_charges(blurs: Sequence[float], noise: float = 1.0) -> FloatArray:
    """Charges (modes,) of which the squares are -2 ln of how much less is said of a mode's mean and split.

    Their sum with the squared residuals is what a normal likelihood makes of deviations that depend on the effect, so
    that a refit can treat them as residuals: they rise from nothing with a slope.

    Parameters
    ----------
    blurs : of the modes (`statorhom.diagnose.prediction.PredictedMode.blur`).
    noise : times the usual deviation.
    """
    return np.asarray(2.0 * np.sqrt(np.log(np.hypot(SHARP * noise, np.array(blurs)) / (SHARP * noise))))


def mixed_cost(blurs: Sequence[float], noise: float = 1.0) -> float:
    """Sum of the squares of `mixed_charges`."""
    return float(np.sum(mixed_charges(blurs, noise) ** 2))
