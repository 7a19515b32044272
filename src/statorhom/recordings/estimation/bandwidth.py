"""How high in frequency a hit reaches."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]

LARGEST_DROP_DB = 25.0
"""A pulse's spectrum runs into its first zero: below this it excites too little to measure with."""


def upper_usable_hz(frequency_hz: FloatArray, force_power: FloatArray) -> float:
    """Frequency at which the force's spectrum has fallen too far below its largest value.

    Parameters
    ----------
    frequency_hz : array, shape (lines,)
        Ascending.
    force_power : array, shape (lines,)
        Autospectrum of the windowed force, in any unit.

    Returns
    -------
    float
        The last frequency before the fall; the last one at all where the force reaches so far.
    """
    strongest = int(np.argmax(force_power))
    fallen = force_power[strongest:] < force_power[strongest] * 10.0 ** (-LARGEST_DROP_DB / 10.0)
    last = strongest + int(np.argmax(fallen)) - 1 if fallen.any() else len(frequency_hz) - 1
    return float(frequency_hz[last])
