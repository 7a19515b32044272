"""How a resonance moves with the level of the force: what a linear structure's does not.

Near a resonance a small change ε of its complex frequency moves the FRF along, H(f) → H(f − ε), and a change of
its modal constant scales it. So the difference of two levels' FRFs is a combination of H and dH/df, which is
fitted over all FRFs of the set at once, without extracting a mode.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from statorhom.errors import RecordingError
from statorhom.recordings.frf_set import FrfSet

FloatArray = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]

_FEWEST_LINES = 5


@dataclass(frozen=True)
class ResonanceShift:
    """Change of a resonance with the force's level.

    Attributes
    ----------
    frequency_shift, damping_shift : array, shape (levels,)
        Relative change of frequency and change of damping ratio since the lowest level.
    frequency_slope, damping_slope : float
        The same per factor of ten of the force. Dry friction lowers the frequency and raises the damping.
    slope_sd : float
        Standard deviation of either slope, from what the combination of H and dH/df leaves of the differences.
    """

    frequency_shift: FloatArray
    damping_shift: FloatArray
    frequency_slope: float
    damping_slope: float
    slope_sd: float


def resonance_shift(
    frf_sets: Sequence[FrfSet], force_levels_n: Sequence[float], near_hz: float, width_hz: float
) -> ResonanceShift:
    """Trend of one resonance over FRFs that were measured at several force levels.

    Parameters
    ----------
    frf_sets : sequence of FrfSet, one per level
        Of the same pairs of points on the same lines.
    force_levels_n : sequence of float, one per level
        Peak force (N).
    near_hz, width_hz : float
        Middle and width of the band that the resonance dominates (Hz), at least five lines.

    Raises
    ------
    RecordingError
        When the sets do not match, hold no such band or were all measured at one level.
    """
    _check(frf_sets, force_levels_n)
    order = np.argsort(force_levels_n)
    lowest = frf_sets[order[0]]
    band = np.abs(lowest.frequency_hz - near_hz) <= 0.5 * width_hz
    if np.count_nonzero(band) < _FEWEST_LINES:
        raise RecordingError(
            f"fewer than {_FEWEST_LINES} lines lie within {width_hz:g} Hz around {near_hz:g} Hz"
        )
    shifts, variances = np.zeros(len(frf_sets), dtype=complex), np.zeros(len(frf_sets))
    for level in order[1:]:
        shifts[level], variances[level] = _shift(lowest, frf_sets[level], band)
    decades = np.log10(np.asarray(force_levels_n, dtype=float) / force_levels_n[order[0]])
    weight = decades / np.sum(decades**2)
    relative = shifts / near_hz
    slope = complex(weight @ relative)
    return ResonanceShift(
        frequency_shift=relative.real,
        damping_shift=relative.imag,
        frequency_slope=slope.real,
        damping_slope=slope.imag,
        slope_sd=float(np.sqrt(weight**2 @ variances)) / near_hz,
    )


def _shift(first: FrfSet, second: FrfSet, band: npt.NDArray[np.bool_]) -> tuple[complex, float]:
    """Change ε of the complex frequency (Hz) and the variance of its real or imaginary part."""
    a, b = first.accelerance[:, band], second.accelerance[:, band]
    # about the mean of both levels the first order is right to the second
    middle = 0.5 * (a + b)
    gradient = np.asarray(np.gradient(middle, first.frequency_hz[band], axis=1), dtype=complex)
    slope, change = _without(gradient, middle), _without(b - a, middle)
    size = float(np.sum(np.abs(slope) ** 2))
    if not size > 0.0:
        raise RecordingError(f"{first.source or 'the FRFs'}: nothing resonates in the band")
    shift = -complex(np.sum(slope.conj() * change)) / size
    residual = change + shift * slope
    freedom = a.size - len(a) - 1
    return shift, 0.5 * float(np.sum(np.abs(residual) ** 2)) / freedom / size


def _without(values: ComplexArray, part: ComplexArray) -> ComplexArray:
    """Each row without its component along the same row of `part`."""
    size = np.sum(np.abs(part) ** 2, axis=1)
    along = np.sum(part.conj() * values, axis=1) / np.where(size > 0.0, size, 1.0)
    return np.asarray(values - along[:, np.newaxis] * part)


def _check(frf_sets: Sequence[FrfSet], force_levels_n: Sequence[float]) -> None:
    levels = np.asarray(force_levels_n, dtype=float)
    if len(frf_sets) < 2 or len(frf_sets) != len(levels) or not (levels > 0.0).all() or np.ptp(levels) == 0.0:
        raise RecordingError("a level series needs one positive force level per FRF set, and two that differ")
    first = frf_sets[0]
    for other in frf_sets[1:]:
        same_points = (other.responses, other.references) == (first.responses, first.references)
        if not same_points or not np.array_equal(other.frequency_hz, first.frequency_hz):
            raise RecordingError(
                f"{other.source or 'an FRF set'}: the levels of a series need the same points and lines as "
                f"{first.source or 'the first'}"
            )
