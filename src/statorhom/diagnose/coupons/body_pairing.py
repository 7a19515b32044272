"""Which measured mode of a coupon is which predicted one: by shape where shapes were seen, else by rank."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.optimize import linear_sum_assignment

from statorhom.diagnose.coupons.body_prediction import PredictedBody
from statorhom.diagnose.measured.measured_test import MeasuredTest
from statorhom.identify.residuals.stage_problem import EXPECTED, FOUND, HALF_FOUND, PAIRING_SD
from statorhom.modes.pairing import pair

FloatArray = npt.NDArray[np.float64]
Partners = tuple[int | None, ...]

# of ln f where shapes were seen: beside unknown constants, and beside known ones
FAR_SD, NEAR_SD = 0.3, 0.06
GATE = 10.0  # in units of PAIRING_SD
UNLIKE = 50.0  # cost of a pair whose shapes are at right angles
ALONE = 60.0  # of a measured mode without a partner, where shapes were seen


@dataclass(frozen=True)
class _Line:
    """A predicted mode as the pairing wants it: without a name."""

    frequency_hz: float
    visibility: float
    order: int | None = None
    axial: int | None = None
    kind: str = ""
    multiplicity: int = 1


def body_partners(test: MeasuredTest, predicted: PredictedBody, *, by_rank: bool = False) -> Partners:
    """Number of the predicted mode of every measured one.

    Parameters
    ----------
    by_rank : of the same rank among the visible ones, however far away: the constants are not known yet.
    """
    if test.points is not None:
        return _by_shape(test, predicted, FAR_SD if by_rank else NEAR_SD)
    if by_rank:
        return _by_rank(test, predicted)
    lines = [
        _Line(float(np.exp(f)), float(v)) for f, v in zip(predicted.log_f, predicted.visibility, strict=True)
    ]
    nameless = [_Line(mode.frequency_hz, 1.0) for mode in test.modes]
    found: list[int | None] = [None] * len(test.modes)
    for p in pair(nameless, lines, PAIRING_SD, gate=GATE, with_doubt=False).pairs:
        found[p.measured] = p.simulated
    return tuple(found)


def _by_rank(test: MeasuredTest, predicted: PredictedBody) -> Partners:
    visible = np.flatnonzero(predicted.visibility >= EXPECTED).tolist()
    return tuple(visible[i] if i < len(visible) else None for i in range(len(test.modes)))


def _by_shape(test: MeasuredTest, predicted: PredictedBody, log_sd: float) -> Partners:
    assert test.points is not None and predicted.motion is not None
    measured = np.log([mode.frequency_hz for mode in test.modes])
    away = (measured[:, None] - predicted.log_f[None, :]) / log_sd
    cost = away**2 + UNLIKE * (1.0 - alike(test.points.motion, predicted.motion.T))
    table = np.hstack([cost, np.full((len(measured), len(measured)), ALONE)])
    _, columns = linear_sum_assignment(table)
    n = len(predicted.log_f)
    return tuple(int(j) if j < n else None for j in columns)


def alike(measured: FloatArray, predicted: FloatArray) -> FloatArray:
    """MAC (a, b) of shapes (a, p) and (b, p)."""
    both = (measured @ predicted.T) ** 2
    sizes = np.sum(measured**2, axis=1)[:, None] * np.sum(predicted**2, axis=1)[None, :]
    return np.asarray(both / sizes)


def missed(test: MeasuredTest, predicted: PredictedBody, held: Partners) -> float:
    """-2 ln of the chance that a test found none of the visible modes of its band that have no partner."""
    band = np.log([mode.frequency_hz for mode in test.modes])
    inside = (predicted.log_f > band.min()) & (predicted.log_f < band.max())
    inside[[j for j in held if j is not None]] = False
    seen = predicted.visibility[inside]
    return float(-2.0 * np.sum(np.log(1.0 - FOUND * seen / (seen + HALF_FOUND))))
