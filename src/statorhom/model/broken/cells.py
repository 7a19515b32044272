"""Where the elements of the whole stator lie: radial, angular and axial extent of every one in every copy."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from statorhom.mesh.hex_mesh import HalfPitchMesh

_TURN = 2 * np.pi
LEAST = 1e-9  # rad


@dataclass(frozen=True, eq=False)
class Sectors:
    """Angles that pieces of the half pitch take.

    Parameters
    ----------
    angle : (e, 2) lower and upper end in the half pitch (rad).
    slots : N.
    """

    angle: np.ndarray
    slots: int

    @property
    def angles(self) -> np.ndarray:
        """(e, 2 N, 2) lower and upper angle in every copy."""
        pitch = _TURN / self.slots * np.repeat(np.arange(self.slots), 2)
        straight = self.angle[:, None, :] + pitch[None, :, None]
        mirrored = pitch[None, :, None] - self.angle[:, None, ::-1]
        return np.where((np.arange(2 * self.slots) % 2 == 1)[None, :, None], mirrored, straight)

    def share_of_arc(self, start: float, end: float) -> np.ndarray:
        """Share (e, 2 N) of every piece's angle that lies between two angles (rad)."""
        angles = self.angles
        # what has no width of its own is either within or not
        low, high = angles[..., 0] - LEAST, angles[..., 1] + LEAST
        total = np.zeros(low.shape)
        for turn in range(
            int(np.floor((low.min() - end) / _TURN)), int(np.ceil((high.max() - start) / _TURN)) + 1
        ):
            total += np.maximum(
                np.minimum(high, end + turn * _TURN) - np.maximum(low, start + turn * _TURN), 0.0
            )
        return np.asarray(total / (high - low))


@dataclass(frozen=True, eq=False)
class Cells(Sectors):
    """Bounding boxes of some elements in cylindrical coordinates.

    Parameters
    ----------
    radius, z : (e, 2) lower and upper end (m).
    """

    radius: np.ndarray
    z: np.ndarray

    def share_of_depth(self, inner: float, outer: float) -> np.ndarray:
        """Share (e,) of every element's radial extent that lies between two radii (m)."""
        low, high = self.radius.T
        return np.asarray(np.maximum(np.minimum(high, outer) - np.maximum(low, inner), 0.0) / (high - low))


def cells(mesh: HalfPitchMesh, elements: np.ndarray) -> Cells:
    """Extents of elements, given by their numbers."""
    nodes = mesh.nodes[mesh.elements[elements]]
    radius, angle = np.hypot(nodes[..., 0], nodes[..., 1]), np.arctan2(nodes[..., 1], nodes[..., 0])

    def ends(values: np.ndarray) -> np.ndarray:
        # of the corners: mid-sides on arcs bulge by a trace
        return np.stack([values[:, :8].min(axis=1), values[:, :8].max(axis=1)], axis=1)

    return Cells(ends(angle), mesh.slots, ends(radius), ends(nodes[..., 2]))
