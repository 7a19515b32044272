"""What a ring of accelerometers sees of a harmonic's shape: its radial order over the core's height."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from statorhom.mesh.hex_mesh import HalfPitchMesh
from statorhom.model.harmonic import Harmonic
from statorhom.model.surface import SurfacePoints, surface_points

PLANES = 9  # enough for six node planes
_NODE = 0.1  # of the largest amplitude
ANGLES_PER_PITCH = 6  # orders up to 2 N beside the harmonic's own are kept apart


@dataclass(frozen=True)
class RadialProfile:
    """Radial order-h amplitude of shapes of harmonic h, in planes over the core.

    Parameters
    ----------
    planes : (p,) axial positions (m).
    points : interpolation to the planes times the angles of one pitch, planes slowest.
    angles : (a,) angles (rad).
    """

    planes: np.ndarray
    points: SurfacePoints
    angles: np.ndarray

    def orders(self, harmonic: Harmonic, shapes: np.ndarray) -> np.ndarray:
        """Radial amplitude of order h of shapes (3 n, k) in every plane, (p, k), real."""
        motion = self.points.evaluate(harmonic, shapes)[:, 0]
        # the points of the neighbouring pitch carry its phase; the order's own phase takes care of both
        turned = motion.reshape(len(self.planes), len(self.angles), -1)
        wave = np.exp(-1j * harmonic.order * self.angles)
        amplitude = np.einsum("pak,a->pk", turned, wave) / len(self.angles)
        # the mirror symmetry makes it real for cosine shapes and imaginary for the odd singlets
        return np.asarray(amplitude.imag if harmonic.parity == "odd" else amplitude.real)


def radial_profile(mesh: HalfPitchMesh, planes_m: np.ndarray | None = None) -> RadialProfile:
    """Planes over the core's height, the ends included, and angles within one slot pitch.

    Parameters
    ----------
    planes_m : (p,) other axial positions (m).
    """
    planes = usual_planes(mesh.length) if planes_m is None else planes_m
    pitch = 2 * np.pi / mesh.slots
    angles = (np.arange(ANGLES_PER_PITCH) + 0.5) / ANGLES_PER_PITCH * pitch - pitch / 2
    points = surface_points(mesh, np.tile(angles, len(planes)), np.repeat(planes, ANGLES_PER_PITCH))
    return RadialProfile(planes, points, angles)


def usual_planes(length: float) -> np.ndarray:
    """(p,) axial positions over a core of a length, its ends included."""
    return np.linspace(0.02, 0.98, PLANES) * length


def node_planes(profile: np.ndarray, least: float = 0.0) -> np.ndarray:
    """Number of sign changes down each column of (p, k) amplitudes; planes near a node have no sign.

    Near means below a tenth of the column's largest amplitude, or below `least`.
    """
    seen = seen_planes(profile, least)
    # the sign at every plane of the last one above it that has any
    last = np.maximum.accumulate(np.where(seen, np.arange(len(profile))[:, None], -1), axis=0)
    signs = np.where(last < 0, 0.0, np.sign(np.take_along_axis(profile, np.maximum(last, 0), axis=0)))
    return np.asarray((signs[1:] * signs[:-1] < 0).sum(axis=0))


def seen_planes(profile: np.ndarray, least: float = 0.0) -> np.ndarray:
    """Which planes carry a sign, (p, k)."""
    size = np.abs(profile)
    return np.asarray(size > np.maximum(_NODE * size.max(axis=0), least))
