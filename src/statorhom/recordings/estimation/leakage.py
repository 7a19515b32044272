"""Leakage: a response that the end of the record cut off."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]

_PARTS = 8
_FEWEST_SAMPLES = 16  # of a part
_NOISE_QUANTILE = 0.9  # of the lines: modes fill fewer than a tenth, an anti-aliasing filter empties many
_OVER_NOISE = 12.0  # of that line; white noise passes it once in 10¹² lines
_RELEVANT = 1e-3  # of the strongest line's power: what is weaker at the beginning does not matter


def end_level(response: FloatArray) -> tuple[float, int]:
    """How far a free vibration has decayed at the end of its record.

    The spectra of the record's first and last eighth are compared line by line, so a lightly damped mode is
    found below heavily damped ones, and only lines over the last part's noise count.

    Parameters
    ----------
    response : array, shape (samples,)
        From the pulse on.

    Returns
    -------
    level : float
        Amplitude at the end over that at the beginning, of the line that has decayed least; 0 where all
        have decayed into the noise. The modal constant of that mode is off by as much.
    line : int
        Where: in cycles per eighth of the record.
    """
    samples = len(response) // _PARTS
    if samples < _FEWEST_SAMPLES:
        return 0.0, 0
    taper = np.hanning(samples)
    first = np.abs(np.fft.rfft(taper * response[:samples])[1:]) ** 2
    last = np.abs(np.fft.rfft(taper * response[-samples:])[1:]) ** 2
    rings = (last > _OVER_NOISE * np.quantile(last, _NOISE_QUANTILE)) & (first > _RELEVANT * first.max())
    if not rings.any():
        return 0.0, 0
    decayed = np.where(rings, last / np.where(rings, first, 1.0), 0.0)
    # beside a mode's line its skirts have ratios of their own: the strongest of comparable lines is the mode
    line = int(np.argmax(np.where(decayed > 0.5 * decayed.max(), last, 0.0)))
    # from the middle of the first part to that of the last it decays over 7/8 of the record
    return float(decayed[line] ** (0.5 * _PARTS / (_PARTS - 1))), line + 1
