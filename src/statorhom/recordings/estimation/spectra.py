"""Spectra of single hits and their averages."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from statorhom.recordings.estimation.pulses import Pulse
from statorhom.recordings.estimation.segments import FoundHit
from statorhom.recordings.estimation.windows import exponential_window, force_window

FloatArray = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]
BoolArray = npt.NDArray[np.bool_]


@dataclass(frozen=True)
class AveragedSpectra:
    """Auto- and cross-spectra averaged over hits or segments, in any unit.

    Attributes
    ----------
    force, response : array, shape (channels, lines)
        Autospectra.
    cross : complex array, shape (channels, lines)
        Response times conjugate force.
    averages : array, shape (channels,)
        Number of independent averages.
    """

    force: FloatArray
    response: FloatArray
    cross: ComplexArray
    averages: FloatArray


def windowed_force(force: FloatArray, pulses: Sequence[Pulse]) -> FloatArray:
    """Force over its rest, outside of the pulses zero."""
    window = force_window(len(force), pulses[0].start, pulses[-1].stop)
    return np.asarray(window * (force - np.median(force)))


def hit_spectra(
    found: FoundHit, window_decay_per_s: float, lines: slice
) -> tuple[ComplexArray, ComplexArray]:
    """Spectra of the windowed force, shape (lines,), and of the windowed responses, shape (channels, lines)."""
    hit = found.hit
    window = exponential_window(len(hit.force_n), hit.sample_rate_hz, window_decay_per_s)
    response = hit.acceleration_m_s2 - hit.acceleration_m_s2.mean(axis=1, keepdims=True)
    force = np.fft.rfft(window * windowed_force(hit.force_n, found.pulses))[lines]
    return force, np.fft.rfft(window * response, axis=1)[:, lines]


def average_spectra(force: ComplexArray, response: ComplexArray, used: BoolArray) -> AveragedSpectra:
    """Average over the hits that each channel uses.

    Parameters
    ----------
    force : complex array, shape (hits, lines)
    response : complex array, shape (hits, channels, lines)
    used : boolean array, shape (hits, channels)
        At least one hit of every channel.
    """
    averages = used.sum(axis=0).astype(float)
    weights = used / averages
    return AveragedSpectra(
        force=weights.T @ np.abs(force) ** 2,
        response=np.einsum("hc,hcl->cl", weights, np.abs(response) ** 2),
        cross=np.einsum("hc,hcl,hl->cl", weights, response, force.conj()),
        averages=averages,
    )
