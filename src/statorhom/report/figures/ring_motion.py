"""Motion of measured rings over one period, as equation [8] of van der Giet et al. describes it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from statorhom.modes.measured_shape import MeasuredShape
from statorhom.modes.order_spectrum import order_spectrum

_AMPLITUDE = 0.18  # largest drawn displacement over the radius
_CURVE_POINTS = 145


@dataclass(frozen=True)
class RingMotion:
    """Points and smooth rings of a measured shape, ready to be drawn at any phase.

    Attributes
    ----------
    radius_m : float
    z_m : ndarray, shape (planes,)
    angles_rad : ndarray, shape (angles,)
        Of the points.
    points : ndarray of complex, shape (3, planes, angles)
        Drawn motion in (r, θ, z) over the radius; NaN where not measured.
    curve_rad : ndarray, shape (curve,)
        Angles of the smooth rings.
    curves : ndarray of complex, shape (planes, curve)
        Their radial motion over the radius, from the circumferential orders; NaN in planes without.
    """

    radius_m: float
    z_m: np.ndarray
    angles_rad: np.ndarray
    points: np.ndarray
    curve_rad: np.ndarray
    curves: np.ndarray

    @classmethod
    def of(cls, shape: MeasuredShape) -> RingMotion:
        """Scale a shape so that it can be seen: the factor s of equation [8].

        Raises
        ------
        IdentificationError
            When the points do not show circumferential orders.
        """
        spectrum = order_spectrum(shape.radial, shape.angles_rad)
        scale = _AMPLITUDE / float(np.nanmax(np.abs(shape.motion)))
        curve = np.linspace(0.0, 2 * np.pi, _CURVE_POINTS)
        phase = np.arange(spectrum.highest_order + 1)[:, None] * curve
        curves = spectrum.cosine @ np.cos(phase) + spectrum.sine @ np.sin(phase)
        return cls(shape.radius_m, shape.z_m, shape.angles_rad, scale * shape.motion, curve, scale * curves)

    @property
    def phase(self) -> float:
        """Phase at which the radial motion is largest (rad): where the period begins."""
        return float(0.5 * np.angle(np.nansum(self.points[0] ** 2)))

    def rings(self, phase: float) -> np.ndarray:
        """Deformed rings at a phase ω_s t (rad), Cartesian over the radius, shape (planes, curve, 3)."""
        radius = 1 + at_phase(self.curves, phase)
        height = np.broadcast_to((self.z_m / self.radius_m)[:, None], radius.shape)
        return np.stack([radius * np.cos(self.curve_rad), radius * np.sin(self.curve_rad), height], axis=-1)

    def places(self, phase: float) -> np.ndarray:
        """Deformed points at a phase, Cartesian over the radius, shape (planes, angles, 3)."""
        radial, tangential, axial = at_phase(self.points, phase)
        c, s = np.cos(self.angles_rad), np.sin(self.angles_rad)
        around, up = np.nan_to_num(tangential), np.nan_to_num(axial)
        x, y = (1 + radial) * c - around * s, (1 + radial) * s + around * c
        return np.stack([x, y, (self.z_m / self.radius_m)[:, None] + up + 0 * x], axis=-1)


def at_phase(motion: np.ndarray, phase: float) -> np.ndarray:
    """Equation [8]: d = Re{H} cos ω_s t + Im{H} sin ω_s t."""
    return np.asarray(motion.real * np.cos(phase) + motion.imag * np.sin(phase))
