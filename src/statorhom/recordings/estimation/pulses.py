"""Pulses of a force record: trigger and double hits.

A later pulse is looked for with the strongest one as a matched filter: against white noise no linear filter
finds it better (Turin 1960), and ringing of the hammer or of the anti-aliasing filter, which has as much
area below zero as above, largely cancels.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy import signal

FloatArray = npt.NDArray[np.float64]

_SIGMAS_OF_A_HIT = 8.0
_SIGMAS_OF_A_PULSE = 6.0  # a false pulse in one record of a million samples in five hundred
_LEAST_FRACTION = 0.05  # of the strongest pulse; weaker rebounds change an FRF by less than noise does
_CONTACT_FRACTION = 0.05
_RINGING = 2.0  # a pulse stands out from the undershoots beside it by at least this


@dataclass(frozen=True)
class Pulse:
    """A pulse of a force record.

    Attributes
    ----------
    start, stop : int
        First sample in contact and the first one after it.
    height_n : float
        Its largest force over the record's rest, with its sign (N).
    """

    start: int
    stop: int
    height_n: float

    def shifted(self, samples: int) -> Pulse:
        """The same pulse in a record that begins `samples` later."""
        return Pulse(self.start - samples, self.stop - samples, self.height_n)


def noise_sd(record: FloatArray) -> float:
    """Standard deviation of a record's noise, from the median deviation, which short pulses hardly touch."""
    return 1.4826 * float(np.median(np.abs(record - np.median(record))))


def find_pulses(force: FloatArray) -> tuple[Pulse, ...]:
    """Find the pulses of a force record.

    Parameters
    ----------
    force : array, shape (samples,)
        Force of either sign (N).

    Returns
    -------
    tuple of Pulse
        In the order of time; empty where nothing stands out from the noise.
    """
    rest = np.median(force)
    strongest = int(np.argmax(np.abs(force - rest)))
    sign = 1.0 if force[strongest] > rest else -1.0
    push = sign * (force - rest)
    noise = noise_sd(force)
    if push[strongest] <= _SIGMAS_OF_A_HIT * noise:
        return ()
    start, stop = _contact(push, strongest, noise)
    likeness = _likeness(push, push[start:stop])
    least = max(_LEAST_FRACTION, _SIGMAS_OF_A_PULSE * noise_sd(likeness))
    width = stop - start
    # the padding lets a pulse at the record's very beginning be a maximum
    peaks, _ = signal.find_peaks(np.pad(likeness, 1), height=least, distance=width)
    starts = [int(peak) - 1 for peak in peaks if _stands_out(likeness, int(peak) - 1, width)]
    return tuple(Pulse(i, i + width, sign * _height(push, i, width)) for i in starts)


def _contact(push: FloatArray, peak: int, noise: float) -> tuple[int, int]:
    """Samples around the peak that lie over the noise: first one, and first one after them."""
    low = push <= max(_CONTACT_FRACTION * push[peak], 3.0 * noise)
    before, after = np.flatnonzero(low[:peak]), np.flatnonzero(low[peak:])
    start = int(before[-1]) + 1 if len(before) else 0
    stop = peak + int(after[0]) if len(after) else len(push)
    return start, stop


def _likeness(push: FloatArray, pulse: FloatArray) -> FloatArray:
    """Height of a pulse of that shape, in units of its own, if it started at each of the samples."""
    filtered = signal.correlate(push, pulse, mode="full", method="fft")[len(pulse) - 1 :]
    return np.asarray(filtered / np.sum(pulse**2))


def _stands_out(likeness: FloatArray, start: int, width: int) -> bool:
    beside = likeness[max(0, start - 2 * width) : start + 2 * width + 1]
    return bool(likeness[start] > -_RINGING * beside.min())


def _height(push: FloatArray, start: int, width: int) -> float:
    return float(push[start : start + width].max())
