"""Flanks of a resonance peak: a linear one is symmetric in the squared frequency."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.stats import f as fisher

from statorhom.modes.nonlinearity.mode_lines import lines_around
from statorhom.modes.nonlinearity.resonance_fit import (
    ResonanceFit,
    bent_resonance,
    fit_resonance,
)


@dataclass(frozen=True)
class FlankAsymmetry:
    """Widths of the two flanks, from the peak to half of its power, other modes' part taken off.

    Attributes
    ----------
    asymmetry : float
        (upper − lower) / (upper + lower), widths in squared frequency: 0 for a linear mode, negative where
        the upper flank is the steeper one.
    asymmetry_sd : float
        Its standard deviation.
    stiffness_change : float
        Relative change of the stiffness from small amplitudes to the peak that bends the curve so.
    p : float
        Probability of so much asymmetry in a linear mode under the measurement's noise.
    """

    asymmetry: float
    asymmetry_sd: float
    stiffness_change: float
    p: float

    @property
    def steeper(self) -> str:
        """The steeper flank: "upper" or "lower"."""
        return "upper" if self.asymmetry < 0 else "lower"


def flank_asymmetry(
    axis_hz: npt.ArrayLike,
    receptance: npt.ArrayLike,
    frequency_hz: float,
    loss_factor: float,
    sd: npt.ArrayLike | None = None,
    neighbours: Sequence[tuple[float, float]] = (),
) -> FlankAsymmetry:
    """Compare the flanks of a mode's peak.

    A linear resonance and one whose stiffness changes with the squared amplitude are fitted to the same
    lines; an F-test says whether the second explains significantly more. Far modes enter both as a
    constant and a slope.

    Parameters
    ----------
    axis_hz : array_like, shape (lines,)
        Frequencies (Hz), evenly spaced if `sd` is not given.
    receptance : array_like of complex, shape (lines,)
        Of one pair of points (m/N).
    frequency_hz, loss_factor : float
        The mode.
    sd : array_like, shape (lines,), optional
        Standard deviation of the complex receptance; estimated from the lines without it.
    neighbours : sequence of (frequency_hz, loss_factor)
        The other modes. Two modes within a bandwidth look like one bent peak: a doublet's other mode must be
        named here, and the hint then rests on what the two cannot explain.

    Raises
    ------
    IdentificationError
        With fewer than ten lines around the mode.
    """
    lines = lines_around(axis_hz, receptance, frequency_hz, loss_factor, sd)
    linear, bent = (
        fit_resonance(lines, frequency_hz, loss_factor, bent=choice, neighbours=neighbours)
        for choice in (False, True)
    )
    # what even the bent curve leaves widens the noise, never narrows it below what was stated
    noise = bent.misfit / bent.freedom
    noise = noise if sd is None else max(noise, 1.0)
    gain = max(linear.misfit - bent.misfit, 0.0) / noise
    value, slope = _asymmetry(bent), _slope(bent)
    return FlankAsymmetry(
        value, abs(slope) * bent.bend_sd * float(np.sqrt(noise)), bent.bend,
        float(fisher.sf(gain, 1, bent.freedom)),
    )  # fmt: skip


def _asymmetry(fit: ResonanceFit, bend: float | None = None) -> float:
    """From the half-power points of the fitted curve, on x = (f/f_r)²."""
    bend = fit.bend if bend is None else bend
    eta = fit.loss_factor
    x = 1 + eta * np.linspace(-3.0, 3.0, 6001)
    power = np.abs(bent_resonance(x, eta, bend)) ** 2
    peak = int(np.argmax(power))
    half = power >= power[peak] / 2
    # the first crossings beside the peak, so that a shoulder far out does not count
    below = np.flatnonzero(~half)
    lower = x[below[below < peak].max(initial=0)]
    upper = x[below[below > peak].min(initial=x.size - 1)]
    return float((upper + lower - 2 * x[peak]) / (upper - lower))


def _slope(fit: ResonanceFit) -> float:
    step = 0.1 * fit.loss_factor
    return (_asymmetry(fit, step) - _asymmetry(fit, -step)) / (2 * step)
