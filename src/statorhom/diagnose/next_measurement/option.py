"""One measurement that could be made, and what it is worth (physics.md §8)."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from statorhom.diagnose.next_measurement.view import View

Told = Mapping[
    str, tuple[float, float]
]  # quantity → predicted value and standard deviation of its measurement
Predict = Callable[[View], Told]


@dataclass(frozen=True, eq=False)
class Option:
    """A measurement.

    Parameters
    ----------
    what : it is, as an instruction.
    hours : it takes in a workshop.
    predict : what an explanation says of it.
    """

    what: str
    hours: float
    predict: Predict


def expected_gain(option: Option, first: Sequence[View], second: Sequence[View]) -> float:
    """½ (μ_A - μ_B)ᵀ (Σ + ½ (S_A + S_B))⁻¹ (μ_A - μ_B): log evidence that it brings between two explanations.

    Parameters
    ----------
    first, second : the explanations at their optimum, and at points of their uncertainty.
    """
    told = [[option.predict(view) for view in own] for own in (first, second)]
    common = sorted(set.intersection(*(set(t) for own in told for t in own))) if all(told) else []
    if not common:
        return 0.0
    noise = np.diag([max(told[0][0][name][1], 1e-12) ** 2 for name in common])
    mean, spread = [], []
    for own in told:
        values = np.array([[t[name][0] for name in common] for t in own])
        mean.append(values[0])
        spread.append(np.cov(values[1:].T).reshape(noise.shape) if len(values) > 2 else 0.0 * noise)
    difference = mean[0] - mean[1]
    whole = noise + 0.5 * (spread[0] + spread[1])
    return float(0.5 * difference @ np.linalg.solve(whole, difference))
