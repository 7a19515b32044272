"""Complex mode shapes: how far from real they are, and the real shape that represents one best."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]


def phase_collinearity(shape: npt.ArrayLike) -> float:
    """Modal phase collinearity, 1 where all points move in phase or opposition, 0 for a travelling wave.

    ((S_xx − S_yy)² + 4 S_xy²)/(S_xx + S_yy)² of real and imaginary parts (Pappa, Elliott & Schenk 1993,
    without their centring), which equals |Σφ²|²/(Σ|φ|²)² and so does not depend on the common phase.
    """
    values = np.asarray(shape, dtype=complex)
    values = values[np.isfinite(values)]
    energy = float(np.sum(np.abs(values) ** 2))
    return min(1.0, float(np.abs(np.sum(values**2)) / energy) ** 2) if energy > 0 else 1.0


def in_phase(shape: npt.ArrayLike) -> ComplexArray:
    """The shape, turned by a common phase so that its real part is as large as it can be.

    The largest component gets a positive real part.
    """
    values = np.asarray(shape, dtype=complex)
    turned: ComplexArray = values * np.exp(-0.5j * np.angle(np.nansum(values**2)))
    largest = turned[np.nanargmax(np.abs(turned))] if np.isfinite(turned).any() else 1.0
    return -turned if largest.real < 0 else turned


def real_shape(shape: npt.ArrayLike) -> FloatArray:
    """Real shape nearest to a complex one, up to the common phase."""
    real: FloatArray = in_phase(shape).real.copy()
    return real
