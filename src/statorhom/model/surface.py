"""Displacement at points of the outer surface: where accelerometers sit and supports touch."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import scipy.sparse as sp

from statorhom.errors import SupportError
from statorhom.mesh.hex_mesh import HalfPitchMesh
from statorhom.model.element import shape_values
from statorhom.model.harmonic import Harmonic

# upright faces of an element: the fixed reference axis and value, and the two bottom corners along the free one
_FACES = ((0, 0.0, 0, 3), (0, 1.0, 1, 2), (1, 0.0, 0, 1), (1, 1.0, 3, 2))
_MIRROR = np.array([1.0, -1.0, 1.0])  # S: mirroring at a tooth's plane turns u_θ round
TOLERANCE = 1e-6


@dataclass(frozen=True)
class SurfacePoints:
    """Interpolation of the displacement at points of the whole stator's outer surface.

    Parameters
    ----------
    matrix : (3 p, 3 n) cylindrical components (u_r, u_θ, u_z) at each point's image in the half pitch.
    pitch : (p,) number of the slot pitch.
    mirrored : (p,) whether the point lies in the pitch's mirrored half.
    """

    matrix: sp.csr_array
    pitch: np.ndarray
    mirrored: np.ndarray

    def __len__(self) -> int:
        return len(self.pitch)

    def evaluate(self, harmonic: Harmonic, shape: np.ndarray) -> np.ndarray:
        """Complex displacement û e^{i k h α} at the points, (p, 3, …), of shapes (3 n, …) of a harmonic.

        Its real and imaginary part are the two shapes of a doublet.
        """
        local = (self.matrix @ shape).reshape(len(self), 3, *shape.shape[1:])
        extra = (1,) * (shape.ndim - 1)
        mirror = np.where(self.mirrored[:, None], _MIRROR, 1.0).reshape(-1, 3, *extra)
        local = np.where(self.mirrored.reshape(-1, 1, *extra), np.conj(local), local) * mirror
        phase = np.exp(2j * np.pi * harmonic.order / harmonic.slots * self.pitch)
        return np.asarray(local * phase.reshape(-1, 1, *extra))


def surface_radius(mesh: HalfPitchMesh) -> float:
    """Radius of the outer surface (m): the frame's where there is one, else the back of the core."""
    if "frame" in mesh.regions:
        nodes = np.unique(mesh.elements_of("frame"))
        return float(np.hypot(*mesh.nodes[nodes, :2].T).max())
    return mesh.outer_radius


def surface_levels(mesh: HalfPitchMesh) -> np.ndarray:
    """Axial positions (m) of the corner nodes on the outer surface, ascending."""
    faces = _faces(mesh)
    return np.unique(np.round(np.concatenate([faces.low, faces.high]), 9))


def surface_points(mesh: HalfPitchMesh, angles: np.ndarray, z: np.ndarray) -> SurfacePoints:
    """Interpolation at angles (rad) and axial positions (m), one point per entry.

    Raises
    ------
    SupportError
        If a point lies beside the surface.
    """
    angles, z = np.broadcast_arrays(np.asarray(angles, dtype=float), np.asarray(z, dtype=float))
    pitch_angle = 2 * np.pi / mesh.slots
    pitch = np.round(angles / pitch_angle).astype(int)
    local = angles - pitch * pitch_angle
    mirrored = local < 0
    matrix = _faces(mesh).interpolation(np.abs(local), z)
    return SurfacePoints(matrix, pitch % mesh.slots, mirrored)


@lru_cache(maxsize=8)
def _faces(mesh: HalfPitchMesh) -> _Faces:
    return _Faces(mesh)


class _Faces:
    """Element faces on the outer surface: angles, levels and the way through the reference cube."""

    def __init__(self, mesh: HalfPitchMesh) -> None:
        radius = surface_radius(mesh)
        xyz = mesh.nodes[mesh.elements]
        r, angle = np.hypot(xyz[..., 0], xyz[..., 1]), np.arctan2(xyz[..., 1], xyz[..., 0])
        found = []
        for axis, value, a, b in _FACES:
            on = np.all(np.abs(r[:, [a, b, a + 4, b + 4]] - radius) < TOLERANCE * radius, axis=1)
            for e in np.flatnonzero(on):
                found.append((e, axis, value, angle[e, a], angle[e, b], xyz[e, a, 2], xyz[e, a + 4, 2]))
        columns = list(zip(*found, strict=True))
        self.mesh = mesh
        self.element, self.axis = np.array(columns[0]), np.array(columns[1])
        self.value, self.first, self.second = (np.array(c) for c in columns[2:5])
        self.low, self.high = np.array(columns[5]), np.array(columns[6])

    def interpolation(self, angles: np.ndarray, z: np.ndarray) -> sp.csr_array:
        face = self._locate(angles, z)
        along = (angles - self.first[face]) / (self.second - self.first)[face]
        up = (z - self.low[face]) / (self.high - self.low)[face]
        axis, value = self.axis[face], self.value[face]
        reference = np.column_stack(
            [np.where(axis == 0, value, along), np.where(axis == 1, value, along), up]
        )
        values = shape_values(np.clip(reference, 0.0, 1.0))
        return self._assemble(self.mesh.elements[self.element[face]], values, angles)

    def _locate(self, angles: np.ndarray, z: np.ndarray) -> np.ndarray:
        left, right = np.minimum(self.first, self.second), np.maximum(self.first, self.second)
        beside = np.maximum(left - angles[:, None], angles[:, None] - right)
        over = np.maximum(self.low - z[:, None], z[:, None] - self.high)
        # both distances are at most zero inside a face; rounding at its rim is forgiven
        distance = np.maximum(beside, over / self.mesh.outer_radius)
        face = np.argmin(distance, axis=1)
        if np.any(distance[np.arange(len(face)), face] > TOLERANCE):
            raise SupportError(
                f"a point lies beside the outer surface, which spans z = {self.low.min() * 1e3:g} … "
                f"{self.high.max() * 1e3:g} mm; check the support or the measurement grid"
            )
        return face

    def _assemble(self, nodes: np.ndarray, values: np.ndarray, angles: np.ndarray) -> sp.csr_array:
        position = self.mesh.nodes[nodes]
        turn = np.arctan2(position[..., 1], position[..., 0]) - angles[:, None]
        cos, sin = values * np.cos(turn), values * np.sin(turn)
        p = len(angles)
        row = 3 * np.arange(p)[:, None]
        entries = [
            (row, 3 * nodes, cos),
            (row, 3 * nodes + 1, -sin),
            (row + 1, 3 * nodes, sin),
            (row + 1, 3 * nodes + 1, cos),
            (row + 2, 3 * nodes + 2, values),
        ]
        rows = np.concatenate([np.broadcast_to(r, c.shape).ravel() for r, c, _ in entries])
        cols = np.concatenate([c.ravel() for _, c, _ in entries])
        data = np.concatenate([v.ravel() for _, _, v in entries])
        return sp.csr_array((data, (rows, cols)), shape=(3 * p, 3 * len(self.mesh.nodes)))
