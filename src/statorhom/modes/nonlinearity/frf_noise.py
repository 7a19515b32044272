"""Noise of an FRF from the FRF itself."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
from scipy.optimize import nnls

FloatArray = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]

_REWEIGHTINGS = 4
_MIXED = np.array([1.0, 9.0, 9.0, 1.0]) / 20.0  # how much of each line's noise is in a third difference
_THIRD_DIFFERENCE_POWER = 20.0  # 1 + 9 + 9 + 1
# third differences of neighbouring lines share values: 2.31 of them are worth one
_REDUNDANCY = 2.31


def line_noise(frf: ComplexArray) -> tuple[FloatArray, float]:
    """Standard deviation of the noise on evenly spaced lines, from third differences.

    The noise has a floor and a part in proportion to the FRF, as a shaking hand gives it: sd² = a + b |H|².
    A smooth resonance cancels in third differences if a half-power width holds many lines; with few lines
    what is left of it counts as noise, so that tests become cautious, never alarmed.

    Parameters
    ----------
    frf : ndarray of complex, shape (lines,)
        More than three lines.

    Returns
    -------
    sd : ndarray, shape (lines,)
        Root mean square of |noise|, in the unit of the FRF.
    freedom : float
        Degrees of freedom of this estimate.
    """
    scale = float(np.abs(frf).max())
    power = np.abs(np.diff(frf / scale, 3)) ** 2 / _THIRD_DIFFERENCE_POWER
    square = np.abs(frf / scale) ** 2
    around = np.column_stack([np.ones(power.size), np.convolve(square, _MIXED, mode="valid")])
    mean = np.full(power.size, max(float(power.mean()), np.finfo(float).eps ** 2))
    for _ in range(_REWEIGHTINGS):  # the squares scatter in proportion to their mean
        parts = nnls(around / mean[:, None], power / mean)[0]
        mean = np.maximum(around @ parts, 1e-3 * mean)
    sd = scale * np.sqrt(np.maximum(parts[0] + parts[1] * square, mean.min()))
    return sd, max(2.0 * power.size / _REDUNDANCY - 1, 1.0)
