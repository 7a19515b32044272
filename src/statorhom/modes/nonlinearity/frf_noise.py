"""Noise of an FRF from the FRF itself."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

ComplexArray = npt.NDArray[np.complex128]

_THIRD_DIFFERENCE_POWER = 20.0  # 1 + 9 + 9 + 1
# third differences of neighbouring lines share values: 2.31 of them are worth one
_REDUNDANCY = 2.31


def line_noise(frf: ComplexArray) -> tuple[float, float]:
    """Standard deviation of white noise on evenly spaced lines, from third differences.

    A smooth resonance cancels in third differences if a half-power width holds many lines; with few lines
    what is left of it counts as noise, so that tests become cautious, never alarmed.

    Parameters
    ----------
    frf : ndarray of complex, shape (lines,)
        More than three lines.

    Returns
    -------
    sd : float
        Root mean square of |noise|, in the unit of the FRF.
    freedom : float
        Degrees of freedom of this estimate.
    """
    difference = np.diff(frf, 3)
    sd = float(np.sqrt(np.mean(np.abs(difference) ** 2) / _THIRD_DIFFERENCE_POWER))
    return sd, max(2.0 * difference.size / _REDUNDANCY, 1.0)
