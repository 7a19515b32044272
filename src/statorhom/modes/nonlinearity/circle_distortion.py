"""Nyquist plot of a mode: a circle, if the mode is linear."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.optimize import least_squares
from scipy.stats import chi2
from scipy.stats import f as fisher

from statorhom.modes.nonlinearity.mode_lines import lines_around
from statorhom.modes.nonlinearity.resonance_fit import fit_resonance

FloatArray = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]


@dataclass(frozen=True)
class CircleDistortion:
    """Distance of the Nyquist plot from its best circle.

    Attributes
    ----------
    centre : complex
        Of the circle (m/N).
    radius, radius_sd : float
        And its standard deviation (m/N).
    drift : complex
        Change of the centre over one half-power width, which other modes cause (m/N).
    distortion : float
        Root mean square distance from the circle beyond what noise explains, over the radius.
    p : float
        Probability of so large a distance for a true circle under the measurement's noise.
    angle_rad, distance : ndarray, shape (lines,)
        Polar angle of every line around the centre (rad), and its distance outwards over the radius.
    """

    centre: complex
    radius: float
    radius_sd: float
    drift: complex
    distortion: float
    p: float
    angle_rad: FloatArray
    distance: FloatArray

    def __post_init__(self) -> None:
        self.angle_rad.setflags(write=False)
        self.distance.setflags(write=False)


def circle_distortion(
    axis_hz: npt.ArrayLike,
    receptance: npt.ArrayLike,
    frequency_hz: float,
    loss_factor: float,
    sd: npt.ArrayLike | None = None,
    neighbours: Sequence[tuple[float, float]] = (),
) -> CircleDistortion:
    """Fit a circle, drifting with frequency, to the lines around a mode by orthogonal distance regression.

    Parameters
    ----------
    axis_hz, receptance, frequency_hz, loss_factor, sd, neighbours
        As in `flank_asymmetry`.

    Raises
    ------
    IdentificationError
        With fewer than ten lines around the mode.
    """
    lines = lines_around(axis_hz, receptance, frequency_hz, loss_factor, sd)
    axis, frf, spread = lines.axis_hz, lines.frf, lines.sd
    if neighbours:
        frf = frf - fit_resonance(lines, frequency_hz, loss_factor, bent=False, neighbours=neighbours).rest
    offset = (axis - frequency_hz) / (loss_factor * frequency_hz)
    scale = float(np.ptp(np.abs(frf)))
    points = np.divide(frf, scale, dtype=complex)
    weight = np.sqrt(2) * scale / spread
    found = least_squares(_distances, _algebraic_circle(points), args=(points, offset, weight), method="lm")
    freedom = axis.size - found.x.size
    misfit = float(2 * found.cost)
    p = (
        chi2.sf(misfit, freedom)
        if sd is not None
        else fisher.sf(misfit / freedom, freedom, lines.noise_freedom)
    )
    centre, radius = scale * complex(found.x[0], found.x[1]), scale * float(abs(found.x[2]))
    excess = max(misfit - freedom, 0.0) / max(float(np.sum(weight**2)), np.finfo(float).tiny)
    drift = scale * complex(found.x[3], found.x[4])
    around = frf - centre - drift * offset
    return CircleDistortion(
        centre, radius, scale * float(np.sqrt(np.linalg.pinv(found.jac.T @ found.jac)[2, 2])), drift,
        scale * float(np.sqrt(excess)) / radius, float(p), np.angle(around), np.abs(around) / radius - 1,
    )  # fmt: skip


def _distances(p: FloatArray, points: ComplexArray, offset: FloatArray, weight: FloatArray) -> FloatArray:
    distance = np.abs(points - complex(p[0], p[1]) - complex(p[3], p[4]) * offset) - abs(p[2])
    weighted: FloatArray = weight * distance
    return weighted


def _algebraic_circle(points: ComplexArray) -> FloatArray:
    """Start: the circle of Kåsa (1976), without drift."""
    columns = np.column_stack([2 * points.real, 2 * points.imag, np.ones(points.size)])
    x, y, rest = np.linalg.lstsq(columns, np.abs(points) ** 2, rcond=None)[0]
    return np.array([x, y, np.sqrt(max(rest + x**2 + y**2, 1e-12)), 0.0, 0.0])
