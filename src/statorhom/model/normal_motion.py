"""What accelerometers on the faces of a body see of its shapes: the motion along the normals."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from statorhom.mesh.mirror_mesh import TOLERANCE, MirrorMesh
from statorhom.mesh.wing import WingMesh
from statorhom.model.space import Space

MOST = 40  # nodes of a face that are looked at


@dataclass(frozen=True)
class NormalMotion:
    """Components of some surface nodes along the normals.

    Parameters
    ----------
    components : (p,) numbers 3 node + axis; all faces have equally many.
    weights : (p,) of the amplitudes: the mean square of the weighted ones, times the mass, is about 1 for a body that
        moves along the normal of its largest face, and less for others as their faces are smaller.
    """

    components: np.ndarray
    weights: np.ndarray

    def orders(self, space: Space, shapes: np.ndarray) -> np.ndarray:  # noqa: ARG002
        """Weighted amplitudes (p, k) of shapes (3 n, k)."""
        return np.asarray(self.weights[:, None] * np.real(shapes[self.components]))


def upward_motion(mesh: WingMesh) -> NormalMotion:
    """Vertical motion of a wing's upper face, as a roving accelerometer sees it."""
    return NormalMotion(3 * mesh.upper + 2, np.ones(len(mesh.upper)))


def normal_motion(mesh: MirrorMesh) -> NormalMotion:
    """Faces of the box around the part that are no planes of symmetry, each with equally many nodes.

    Accelerometers are put on large faces: a face counts as much as its area over the largest one's.
    """
    low, high = mesh.nodes.min(axis=0), mesh.nodes.max(axis=0)
    areas = np.prod(high - low) / (high - low)
    faces = [(axis, position) for axis in range(3) for position in (low[axis], high[axis])]
    outer = [
        (axis, position)
        for axis, position in faces
        if not any(axis == a and abs(position - p) < TOLERANCE for a, p in mesh.mirrors)
    ]
    components, weights = [], []
    for axis, position in outer:
        nodes = np.flatnonzero(np.abs(mesh.nodes[:, axis] - position) < TOLERANCE)
        chosen = nodes[np.linspace(0, len(nodes) - 1, MOST).round().astype(int)]
        of_axis = sum(a == axis for a, _ in outer)
        components.append(3 * chosen + axis)
        weights.append(np.full(MOST, np.sqrt(len(outer) / of_axis * areas[axis] / areas.max())))
    return NormalMotion(np.concatenate(components), np.concatenate(weights))
