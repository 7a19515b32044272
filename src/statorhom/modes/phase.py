"""The phase that makes a complex shape real, and how real it then is."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]


def phase_collinearity(shape: npt.ArrayLike) -> float:
    """Modal phase collinearity |Σu²|² / (Σ|u|²)²: 1 for a standing wave, 0 for a travelling one.

    This is the eigenvalue form of Pappa, Elliott & Schenk (1993) without removal of the mean, which a
    shape's order 0 would fall victim to. NaN points are left out.
    """
    values = _present(shape)
    power = float(np.sum(np.abs(values) ** 2))
    return float(np.abs(np.sum(values**2)) ** 2 / power**2) if power else float("nan")


def real_phase(shape: npt.ArrayLike) -> float:
    """Angle ψ (rad), −π/2 … π/2, for which shape · e^{−iψ} has the largest real and least imaginary part."""
    return float(0.5 * np.angle(np.sum(_present(shape) ** 2)))


def in_phase(shape: npt.ArrayLike) -> npt.NDArray[np.complex128]:
    """The shape turned by that phase, its largest value with a positive real part; NaN stays."""
    turned = np.asarray(shape, dtype=complex) * np.exp(-1j * real_phase(shape))
    if not np.isfinite(turned).any():
        return turned
    largest = turned.ravel()[np.nanargmax(np.abs(turned))]
    return -turned if largest.real < 0 else turned


def real_shape(shape: npt.ArrayLike) -> FloatArray:
    """Real part of the shape after its rotation, its largest value positive; NaN stays."""
    return np.asarray(in_phase(shape).real)


def _present(shape: npt.ArrayLike) -> npt.NDArray[np.complex128]:
    values = np.asarray(shape, dtype=complex).ravel()
    values = values[np.isfinite(values)]
    return values / max(float(np.abs(values).max(initial=0.0)), np.finfo(float).tiny)
