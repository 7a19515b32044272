"""Force and exponential windows, and the damping that the latter adds.

An exponential window e^(−at) on force and response alike evaluates the transfer function at iω + a instead
of iω (shift theorem of the Laplace transform), so every pole moves by exactly −a and nothing else changes.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]

_LEAST_MARGIN = 16  # samples; ringing of the anti-aliasing filter is part of the force


def force_window(samples: int, start: int, stop: int) -> FloatArray:
    """Rectangle around the pulse with cosine tapers; outside of it the hammer touches nothing.

    Parameters
    ----------
    samples : length of the record.
    start, stop : first sample of contact and first one after it.

    Returns
    -------
    array, shape (samples,)
    """
    margin = max(stop - start, _LEAST_MARGIN)
    time = np.arange(samples)
    outside = np.maximum(start - margin - time, time - (stop - 1 + 2 * margin))
    return np.asarray(0.5 + 0.5 * np.cos(np.pi * np.clip(outside / margin, 0.0, 1.0)))


def decay_of_end_level(end_level: float, duration_s: float) -> float:
    """Decay rate (1/s) of the exponential window that has fallen to `end_level` after `duration_s`."""
    return -float(np.log(end_level)) / duration_s


def exponential_window(samples: int, sample_rate_hz: float, decay_per_s: float) -> FloatArray:
    """e^(−at) from the first sample on.

    Returns
    -------
    array, shape (samples,)
    """
    return np.asarray(np.exp(-decay_per_s * np.arange(samples) / sample_rate_hz))


def true_pole(pole: complex, window_decay_per_s: float) -> complex:
    """The structure's pole from that of windowed records: the decay rate is less by the window's, exactly.

    Parameters
    ----------
    pole : complex
        s = −σ + iω_d as extracted from an FRF of windowed records (rad/s).
    window_decay_per_s : float
        `FrfSet.window_decay_per_s`.
    """
    return pole + window_decay_per_s
