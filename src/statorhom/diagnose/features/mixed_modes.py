"""What a name of mixed modes costs: of several ways of calling them the measured one is one, and had a chance."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
import numpy.typing as npt

from statorhom.diagnose.measured.feature import Feature

FloatArray = npt.NDArray[np.float64]


def charges_of(features: Sequence[Feature]) -> FloatArray:
    """Charges (features,) of which the squares are -2 ln of the chances.

    They rise from nothing with a slope as modes are mixed, so that a refit can treat them as residuals.
    """
    chances = np.array([feature.chance for feature in features])
    return np.sqrt(np.maximum(-2.0 * np.log(chances), 0.0))


def cost_of(features: Iterable[Feature]) -> float:
    """Squared residuals and charges."""
    return sum(f.residual**2 - 2.0 * float(np.log(f.chance)) for f in features)
