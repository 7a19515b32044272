"""Single-degree-of-freedom circle fit, equations [4]–[7] of the stator's paper, misprints corrected.

Around a resonance with structural damping the receptance A/(ω_r² − ω² + iη_r ω_r²) runs along a circle whose
offset carries the other modes. Its sweep rate is largest at ω_r (Kennedy & Pancu 1947; Ewins 2000, §4.3.3).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from statorhom.errors import ExtractionError

FloatArray = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]

_FEWEST_LINES = 5


@dataclass(frozen=True)
class CircleFit:
    """One mode of one receptance.

    Attributes
    ----------
    frequency_hz, loss_factor : float
        Natural frequency and structural loss factor, equation [5].
    modal_constant_per_kg : complex
        A = 2R ω_r² η_r e^{iθ_r}, equation [6], with the diameter's direction at resonance.
    centre, radius : complex, float
        Of the circle (m/N).
    distortion : float
        Root mean square distance of the points from the circle over its radius.
    loss_factor_spread : float
        Relative standard deviation of η over the pairs of points: large where friction or a neighbour bends
        the resonance.
    """

    frequency_hz: float
    loss_factor: float
    modal_constant_per_kg: complex
    centre: complex
    radius: float
    distortion: float
    loss_factor_spread: float

    def receptance(self, frequency_hz: npt.ArrayLike) -> ComplexArray:
        """The mode's part of the receptance (m/N), as in equation [7] with iη_r ω_r² in the denominator."""
        square = (2 * np.pi * self.frequency_hz) ** 2
        squared = (2 * np.pi * np.asarray(frequency_hz, dtype=np.float64)) ** 2
        pole = square * (1 + 1j * self.loss_factor)
        return np.asarray(self.modal_constant_per_kg / (pole - squared), dtype=np.complex128)


@dataclass(frozen=True)
class SdofModel:
    """Equation [7]: modes of one receptance and its residuals −1/(ω²M) and 1/K."""

    modes: tuple[CircleFit, ...]
    mass_line: complex
    stiffness_line: complex


def circle_fit(frequency_hz: npt.ArrayLike, receptance: npt.ArrayLike) -> CircleFit:
    """Fit the circle through the lines around one resonance.

    Parameters
    ----------
    frequency_hz : array_like, shape (lines,)
        Ascending lines around the peak; about one bandwidth to each side.
    receptance : complex array_like, shape (lines,)
        (m/N).

    Raises
    ------
    ExtractionError
        When the lines are too few or do not pass a resonance.
    """
    omega = 2 * np.pi * np.asarray(frequency_hz, dtype=float)
    values = np.asarray(receptance, dtype=complex)
    if omega.size < _FEWEST_LINES or not np.isfinite(values).all():
        raise ExtractionError(
            f"a circle fit needs {_FEWEST_LINES} finite lines around the peak, got {omega.size}"
        )
    centre, radius = _circle(values)
    angle = np.unwrap(np.angle(values - centre))
    square, loss, spread = _resonance(omega, angle)
    if not (loss > 0 and omega[0] ** 2 < square < omega[-1] ** 2):
        raise ExtractionError(
            f"no resonance between {omega[0] / 2 / np.pi:.1f} and {omega[-1] / 2 / np.pi:.1f} Hz: "
            "choose the lines around a peak"
        )
    at_resonance = centre + radius * np.exp(1j * np.interp(np.sqrt(square), omega, angle))
    # at resonance the mode is A/(iηω_r²): the diameter from the far point of the circle
    diameter = 2 * (at_resonance - centre)
    return CircleFit(
        float(np.sqrt(square) / (2 * np.pi)),
        loss,
        complex(1j * loss * square * diameter),
        centre,
        radius,
        float(np.sqrt(np.mean((np.abs(values - centre) / radius - 1) ** 2))),
        spread,
    )


def _circle(values: ComplexArray) -> tuple[complex, float]:
    """Algebraic least-squares circle (Kåsa 1976) in coordinates of unit size."""
    middle = complex(values.mean())
    size = float(np.abs(values - middle).max())
    if size == 0.0:
        raise ExtractionError("the receptance is constant: no circle passes through it")
    z = (values - middle) / size
    matrix = np.stack([z.real, z.imag, np.ones(z.size)], axis=1)
    solution = np.linalg.lstsq(matrix, np.abs(z) ** 2, rcond=None)[0]
    centre = 0.5 * complex(solution[0], solution[1])
    radius = float(np.sqrt(solution[2] + abs(centre) ** 2))
    return middle + size * centre, size * radius


def _resonance(omega: FloatArray, angle: FloatArray) -> tuple[float, float, float]:
    """ω_r², η_r and its spread from the angles around the circle.

    Seen from the circle's centre the angle is α = α_r − 2 arctan((ω² − ω_r²)/(ηω_r²)), so that tan of half of
    it is linear in ω² and equation [5] holds for every pair of points around the resonance.
    """
    rate = -np.gradient(angle, omega**2)
    start = int(np.argmax(rate))
    reference = float(angle[start])
    square, width = float(omega[start] ** 2), 2.0 / max(float(rate[start]), np.finfo(float).tiny)
    for _ in range(50):
        change = (omega**2 - square) / width
        residual = angle - (reference - 2 * np.arctan(change))
        # Gauss–Newton on angle at resonance, ω_r² and ηω_r²
        change = np.clip(change, -1e6, 1e6)
        slope = 2.0 / (1 + change**2) / width
        jacobian = np.stack([np.ones_like(omega), slope, slope * change], axis=1)
        scale = np.maximum(np.linalg.norm(jacobian, axis=0), np.finfo(float).tiny)
        step = np.linalg.lstsq(jacobian / scale, residual, rcond=None)[0] / scale
        reference, square, width = reference + step[0], square + step[1], max(width + step[2], 0.2 * width)
        if abs(step[1]) + abs(step[2]) < 1e-14 * abs(square):
            break
    half = np.tan(0.5 * (angle - reference))
    before, after = np.flatnonzero(omega**2 < square), np.flatnonzero(omega**2 > square)
    if not (len(before) and len(after)):
        return square, float("nan"), float("nan")
    pairs = (omega[after][:, None] ** 2 - omega[before][None] ** 2) / (
        square * (half[before][None] - half[after][:, None])
    )
    return square, width / square, float(np.std(pairs) / abs(np.mean(pairs)))


def sdof_model(
    frequency_hz: npt.ArrayLike, receptance: npt.ArrayLike, bands_hz: Sequence[tuple[float, float]]
) -> SdofModel:
    """Circle fits in the bands, and the residuals that meet the FRF at the ends of its axis."""
    frequency = np.asarray(frequency_hz, dtype=float)
    values = np.asarray(receptance, dtype=complex)
    modes = []
    for low, high in bands_hz:
        inside = (frequency >= low) & (frequency <= high)
        modes.append(circle_fit(frequency[inside], values[inside]))
    rest = values - sum((mode.receptance(frequency) for mode in modes), np.zeros_like(values))
    squared = (2 * np.pi * frequency) ** 2
    ends = np.array([0, -1])
    matrix = np.stack([1.0 / squared[ends], np.ones(2)], axis=1)
    mass_line, stiffness_line = np.linalg.solve(matrix, rest[ends])
    return SdofModel(tuple(modes), complex(mass_line), complex(stiffness_line))


def regenerate(model: SdofModel, frequency_hz: npt.ArrayLike) -> ComplexArray:
    """Receptance (m/N) of equation [7]."""
    frequency = np.asarray(frequency_hz, dtype=float)
    total = model.mass_line / (2 * np.pi * frequency) ** 2 + model.stiffness_line
    for mode in model.modes:
        total = total + mode.receptance(frequency)
    return np.asarray(total, dtype=np.complex128)
