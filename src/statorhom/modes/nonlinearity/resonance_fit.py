"""Least-squares fits of one resonance, linear or with a frequency that bends with the amplitude."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.optimize import least_squares

from statorhom.modes.nonlinearity.mode_lines import ModeLines

FloatArray = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]

_ITERATIONS = 8  # each halves the error, at least, up to a bend of the loss factor's size
_NEAR = 15.0  # half-power widths: the terms of modes farther away are as good as straight lines


@dataclass(frozen=True)
class ResonanceFit:
    """One resonance H = A / (1 − x + bend · |m|² + iη) + rest with x = (f/f_r)².

    m is the first term over its largest. The rest is B + C (x − 1), which stands for far modes, and a term
    like the first, without bend, for every near one.

    Attributes
    ----------
    frequency_hz : float
        f_r (Hz).
    loss_factor : float
        η.
    bend, bend_sd : float
        Relative change of the stiffness from no amplitude to the largest, and its standard deviation;
        0 in a linear fit.
    constant : complex
        A, in the unit of the FRF.
    misfit : float
        Weighted sum of squares: that of 2 · lines − parameters standard normal numbers for a true model.
    freedom : int
        Its degrees of freedom.
    fitted : ndarray of complex, shape (lines,)
        The fitted FRF.
    rest : ndarray of complex, shape (lines,)
        Its part that belongs to other modes.
    """

    frequency_hz: float
    loss_factor: float
    bend: float
    bend_sd: float
    constant: complex
    misfit: float
    freedom: int
    fitted: ComplexArray
    rest: ComplexArray


def fit_resonance(
    lines: ModeLines,
    frequency_hz: float,
    loss_factor: float,
    *,
    bent: bool,
    neighbours: Sequence[tuple[float, float]] = (),
) -> ResonanceFit:
    """Fit one resonance to the lines around a mode.

    All complex amplitudes are linear and eliminated (variable projection), so only f_r, η and the bend are
    searched for.

    Parameters
    ----------
    lines : ModeLines
        Lines around the mode.
    frequency_hz, loss_factor : float
        Where to start.
    bent : bool
        Whether to fit the bend too.
    neighbours : sequence of (frequency_hz, loss_factor)
        Other modes; those near this one, such as a doublet's other mode, are fitted in amplitude.
    """
    axis_hz, frf, weight = lines.axis_hz, lines.frf, np.sqrt(2) / lines.sd
    offset = axis_hz / frequency_hz

    reach = _NEAR * loss_factor * frequency_hz
    others = [(f, eta) for f, eta in neighbours if abs(f - frequency_hz) <= reach]
    fixed = [eta / (1 - (axis_hz / f) ** 2 + 1j * eta) for f, eta in others]

    def columns(p: FloatArray) -> ComplexArray:
        return np.column_stack([_columns(offset, loss_factor, p), *fixed])

    def residual(p: FloatArray) -> FloatArray:
        matrix = columns(p) * weight[:, None]
        rest = weight * frf - matrix @ np.linalg.lstsq(matrix, weight * frf, rcond=None)[0]
        return np.concatenate([rest.real, rest.imag])

    found = least_squares(residual, np.zeros(3 if bent else 2), x_scale=0.1, method="lm")
    final = columns(found.x)
    amplitudes = np.linalg.lstsq(final * weight[:, None], weight * frf, rcond=None)[0]
    spread = np.sqrt(np.diag(np.linalg.pinv(found.jac.T @ found.jac)))
    return ResonanceFit(
        frequency_hz * (1 + loss_factor * float(found.x[0])),
        loss_factor * float(np.exp(found.x[1])),
        loss_factor * float(found.x[2]) if bent else 0.0,
        loss_factor * float(spread[2]) if bent else 0.0,
        complex(amplitudes[0]),
        float(2 * found.cost),
        2 * axis_hz.size - 6 - 2 * len(fixed) - found.x.size,
        final @ amplitudes,
        final[:, 1:] @ amplitudes[1:],
    )


def bent_resonance(x: FloatArray, loss_factor: float, bend: float) -> ComplexArray:
    """Motion η / (1 − x + bend · |m|² + iη) that holds itself at x = (f/f_r)², by fixed-point iteration."""
    motion = np.divide(loss_factor, 1 - x + 1j * loss_factor, dtype=complex)
    for _ in range(_ITERATIONS if bend else 0):
        motion = np.divide(loss_factor, 1 - x + bend * np.abs(motion) ** 2 + 1j * loss_factor, dtype=complex)
    return motion


def _columns(offset: FloatArray, loss_factor: float, p: FloatArray) -> ComplexArray:
    """Columns of A, B and C for steps p = (frequency in half-power widths, ln loss factor, bend in them)."""
    x = (offset / (1 + loss_factor * p[0])) ** 2
    loss = loss_factor * np.exp(p[1])
    bent = bent_resonance(x, float(loss), loss_factor * float(p[2]) if p.size > 2 else 0.0)
    columns: ComplexArray = np.column_stack([bent, np.ones_like(bent), (x - 1) / loss_factor + 0j])
    return columns
