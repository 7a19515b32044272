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
    """Components of some surface nodes along the outward normals.

    Parameters
    ----------
    components : (p,) numbers 3 node + axis; all faces have equally many.
    scale : of the amplitudes: their mean square, times the mass, is 1 for a body that moves as a whole along one axis.
    """

    components: np.ndarray
    scale: float

    def orders(self, space: Space, shapes: np.ndarray) -> np.ndarray:  # noqa: ARG002
        """Amplitudes (p, k) of shapes (3 n, k)."""
        return np.asarray(self.scale * np.real(shapes[self.components]))


def upward_motion(mesh: WingMesh) -> NormalMotion:
    """Vertical motion of a wing's upper face, as a roving accelerometer sees it."""
    return NormalMotion(3 * mesh.upper + 2, 1.0)


def normal_motion(mesh: MirrorMesh) -> NormalMotion:
    """Faces of the box around the part that are no planes of symmetry, each with equally many nodes."""
    low, high = mesh.nodes.min(axis=0), mesh.nodes.max(axis=0)
    faces = [(axis, position) for axis in range(3) for position in (low[axis], high[axis])]
    inner = [(axis, position) for axis, position in mesh.mirrors]
    found = []
    for axis, position in faces:
        if any(axis == a and abs(position - p) < TOLERANCE for a, p in inner):
            continue
        nodes = np.flatnonzero(np.abs(mesh.nodes[:, axis] - position) < TOLERANCE)
        chosen = nodes[np.linspace(0, len(nodes) - 1, MOST).round().astype(int)]
        found.append(3 * chosen + axis)
    return NormalMotion(np.concatenate(found), float(np.sqrt(3.0)))
