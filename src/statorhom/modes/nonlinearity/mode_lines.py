"""The lines of an FRF around one mode, with their noise."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from statorhom.errors import IdentificationError
from statorhom.modes.nonlinearity.frf_noise import line_noise

FloatArray = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]

_FEWEST_LINES = 10
_HALF_WINDOW = 2.0  # half-power widths on either side of the resonance


@dataclass(frozen=True)
class ModeLines:
    """Lines around a mode.

    Attributes
    ----------
    axis_hz : ndarray, shape (lines,)
        Frequencies (Hz).
    frf : ndarray of complex, shape (lines,)
        Receptance (m/N).
    sd : ndarray, shape (lines,)
        Standard deviation of the complex receptance.
    noise_freedom : float
        Degrees of freedom of that deviation; infinite where it was given.
    """

    axis_hz: FloatArray
    frf: ComplexArray
    sd: FloatArray
    noise_freedom: float


def lines_around(
    axis_hz: npt.ArrayLike,
    receptance: npt.ArrayLike,
    frequency_hz: float,
    loss_factor: float,
    sd: npt.ArrayLike | None = None,
) -> ModeLines:
    """Lines within two half-power widths of a mode that have a finite value.

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

    Raises
    ------
    IdentificationError
        When fewer than ten lines lie there.
    """
    axis, frf = np.asarray(axis_hz, dtype=float), np.asarray(receptance, dtype=complex)
    near = (np.abs(axis - frequency_hz) <= _HALF_WINDOW * loss_factor * frequency_hz) & np.isfinite(frf)
    if near.sum() < _FEWEST_LINES:
        raise IdentificationError(
            f"{int(near.sum())} lines around the mode at {frequency_hz:.4g} Hz: hints of non-linearity need "
            f"{_FEWEST_LINES}"
        )
    if sd is not None:
        return ModeLines(axis[near], frf[near], np.asarray(sd, dtype=float)[near], float("inf"))
    return ModeLines(axis[near], frf[near], *line_noise(frf[near]))
