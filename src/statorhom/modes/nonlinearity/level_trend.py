"""Frequency and loss factor of one mode over tests with different force levels."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.stats import norm
from scipy.stats import t as student

from statorhom.errors import IdentificationError

FloatArray = npt.NDArray[np.float64]


@dataclass(frozen=True)
class LevelTrend:
    """Change of a mode with the force level.

    Attributes
    ----------
    frequency_per_decade, frequency_sd : float
        Relative change of the natural frequency per decade of force, and its standard deviation.
    loss_per_decade, loss_sd : float
        The same of the loss factor, as a change of its natural logarithm.
    p : float or None
        Probability that levels without influence give so much of a trend in either of the two; None where
        two tests without standard deviations cannot tell.
    """

    frequency_per_decade: float
    frequency_sd: float
    loss_per_decade: float
    loss_sd: float
    p: float | None


def level_trend(
    force_level_n: npt.ArrayLike,
    frequency_hz: npt.ArrayLike,
    loss_factor: npt.ArrayLike,
    frequency_sd_hz: npt.ArrayLike | None = None,
    loss_factor_sd: npt.ArrayLike | None = None,
) -> LevelTrend:
    """Weighted regression of ln f and ln η on the logarithm of the force level.

    Parameters
    ----------
    force_level_n : array_like, shape (tests,)
        Peak forces (N), two different ones at least.
    frequency_hz, loss_factor : array_like, shape (tests,)
        The mode in each test.
    frequency_sd_hz, loss_factor_sd : array_like, shape (tests,), optional
        Their standard deviations; equal ones are estimated from three or more tests without them.

    Raises
    ------
    IdentificationError
        With fewer than two levels, or values that are not positive.
    """
    level, f, eta = (np.asarray(a, dtype=float) for a in (force_level_n, frequency_hz, loss_factor))
    if not all(np.all(np.isfinite(a) & (a > 0)) for a in (level, f, eta)) or np.unique(level).size < 2:
        raise IdentificationError(
            "a trend over the force level needs force_level_n of two different tests at least, and positive "
            "frequencies and loss factors"
        )
    decades = np.log10(level)
    of_f = _regression(
        decades, np.log(f), None if frequency_sd_hz is None else np.asarray(frequency_sd_hz) / f
    )
    of_loss = _regression(
        decades, np.log(eta), None if loss_factor_sd is None else np.asarray(loss_factor_sd) / eta
    )
    known = [p for p in (of_f[2], of_loss[2]) if p is not None]
    # the smaller of several probabilities is small more often: Bonferroni
    joint = min(1.0, len(known) * min(known)) if known else None
    return LevelTrend(of_f[0], of_f[1], of_loss[0], of_loss[1], joint)


def _regression(x: FloatArray, y: FloatArray, sd: FloatArray | None) -> tuple[float, float, float | None]:
    """Slope, its standard deviation and the two-sided probability of it without a trend."""
    weight = np.ones_like(y) if sd is None else sd**-2.0
    away = x - np.average(x, weights=weight)
    strength = float(np.sum(weight * away**2))
    slope = float(np.sum(weight * away * y)) / strength
    rest = y - np.average(y, weights=weight) - slope * away
    freedom = x.size - 2
    scatter = float(np.sum(weight * rest**2)) / freedom if freedom else float("nan")
    if sd is None:
        spread = float(np.sqrt(scatter / strength))
        if not freedom or spread == 0.0:
            return slope, spread, None
        return slope, spread, float(2 * student.sf(abs(slope) / spread, freedom))
    # scatter beyond the stated deviations widens them; less scatter is chance
    wider = freedom > 0 and scatter > 1.0
    spread = float(np.sqrt((scatter if wider else 1.0) / strength))
    tail = student.sf(abs(slope) / spread, freedom) if wider else norm.sf(abs(slope) / spread)
    return slope, spread, float(2 * tail)
