"""The outer surface of the whole stator as a grid of eight-node quadrilaterals."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from statorhom.mesh.hex_mesh import HalfPitchMesh
from statorhom.model.surface import TOLERANCE, SurfacePoints, surface_levels, surface_points, surface_radius


@dataclass(frozen=True)
class SurfaceGrid:
    """Corners of the element faces on the outer surface; mid-side nodes lie half-way between them.

    Parameters
    ----------
    radius : of the surface (m).
    angles : (a,) corner angles of one turn, ascending from 0 (rad).
    levels : (e + 1,) axial positions of the corners, ascending (m).
    """

    radius: float
    angles: np.ndarray
    levels: np.ndarray

    def __post_init__(self) -> None:
        for array in (self.angles, self.levels):
            array.setflags(write=False)

    @property
    def node_levels(self) -> np.ndarray:
        """(2 e + 1,) axial positions of corners and mid-sides (m)."""
        middles = (self.levels[:-1] + self.levels[1:]) / 2
        return np.sort(np.concatenate([self.levels, middles]))


def surface_grid(mesh: HalfPitchMesh) -> SurfaceGrid:
    """Grid of a mesh's outer surface."""
    radius = surface_radius(mesh)
    corners = mesh.nodes[np.unique(mesh.elements[:, :8])]
    on = np.abs(np.hypot(*corners[:, :2].T) - radius) < TOLERANCE * radius
    half = np.unique(np.round(np.arctan2(corners[on, 1], corners[on, 0]), 9))
    half[-1] = np.pi / mesh.slots
    # upwards from the tooth's centre to the slot's, then the next pitch's mirrored half
    one = np.concatenate([half, 2 * half[-1] - half[-2:0:-1]])
    angles = (2 * half[-1] * np.arange(mesh.slots)[:, None] + one).ravel()
    return SurfaceGrid(radius, angles, surface_levels(mesh))


@dataclass(frozen=True)
class SamplingGrid:
    """A regular grid of accelerometers on the outer surface.

    Parameters
    ----------
    angles : (a,) equidistant (rad).
    planes : (p,) axial positions (m).
    points : (p a,) the planes slowest.
    """

    angles: np.ndarray
    planes: np.ndarray
    points: SurfacePoints


def sampling_grid(mesh: HalfPitchMesh, angles: int = 48, planes: int = 7) -> SamplingGrid:
    """Grid over the part of the core's height that the outer surface covers, two percent inside its ends."""
    levels = surface_levels(mesh)
    low, high = max(0.0, levels[0]), min(mesh.length, levels[-1])
    theta = np.arange(angles) * 2 * np.pi / angles
    z = low + (high - low) * np.linspace(0.02, 0.98, planes)
    points = surface_points(mesh, np.tile(theta, planes), np.repeat(z, angles))
    return SamplingGrid(theta, z, points)
