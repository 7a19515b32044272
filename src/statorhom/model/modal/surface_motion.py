"""Motion of places on the surface of a body with mirror planes, out of shapes of the part that it is copied from."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt
from scipy.interpolate import CloughTocher2DInterpolator, NearestNDInterpolator

from statorhom.mesh.mirror_mesh import TOLERANCE, MirrorMesh
from statorhom.mesh.wing import WingMesh

FloatArray = npt.NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class SurfaceMotion:
    """Shapes on the large faces of a plate, a beam or a wing, seen from above.

    Parameters
    ----------
    mesh : of the part.
    shapes : (3 n, k) displacements of the part.
    parities : (k,) combination of parities of each shape.
    """

    mesh: MirrorMesh
    shapes: FloatArray
    parities: npt.NDArray[np.int_]

    def at(self, places: FloatArray) -> FloatArray:
        """Displacements (p, 3, k) of places (p, 3); those beside the body move with the nearest node.

        Heights only tell the upper from the lower side of a body that has a plane of symmetry between them.
        """
        image, flipped = image_of(self.mesh, places)
        moved = self._field(image[:, :2]).reshape(len(image), 3, -1)
        for i in range(len(self.mesh.mirrors)):
            moved[flipped[:, i]] *= self._signs[:, i].T
        return moved

    @cached_property
    def _signs(self) -> FloatArray:
        """(k, planes, 3) what mirroring does to the components of every shape."""
        return np.array([self.mesh.signs(int(parity)) for parity in self.parities])

    @cached_property
    def _nodes(self) -> npt.NDArray[np.int_]:
        return outer_nodes(self.mesh)

    def _field(self, plan: FloatArray) -> FloatArray:
        """Values (p, 3 k) at places (p, 2) of the part."""
        found = np.asarray(self._smooth(plan))
        outside = np.isnan(found).any(axis=1)
        if outside.any():
            found[outside] = self._nearest(plan[outside])
        return found

    @cached_property
    def _values(self) -> FloatArray:
        return self.shapes.reshape(-1, 3, self.shapes.shape[1])[self._nodes].reshape(len(self._nodes), -1)

    @cached_property
    def _smooth(self) -> CloughTocher2DInterpolator:
        # a plate's length and a beam's width get equal rights
        return CloughTocher2DInterpolator(self.mesh.nodes[self._nodes, :2], self._values, rescale=True)

    @cached_property
    def _nearest(self) -> NearestNDInterpolator:
        return NearestNDInterpolator(self.mesh.nodes[self._nodes, :2], self._values)


def image_of(mesh: MirrorMesh, places: FloatArray) -> tuple[FloatArray, npt.NDArray[np.bool_]]:
    """Images (p, 3) of places (p, 3) in the part, and at which planes (p, planes) they were mirrored."""
    image = np.array(places, dtype=float)
    flipped = np.zeros((len(image), len(mesh.mirrors)), dtype=bool)
    for i, (axis, position) in enumerate(mesh.mirrors):
        side = 1.0 if mesh.nodes[:, axis].mean() < position else -1.0
        flipped[:, i] = side * image[:, axis] > side * position
        image[flipped[:, i], axis] = 2 * position - image[flipped[:, i], axis]
    return image, flipped


def outer_nodes(mesh: MirrorMesh) -> npt.NDArray[np.int_]:
    """Nodes of the part's face that looks up or down: of a wing the upper one, of a block the one at its lowest z."""
    if isinstance(mesh, WingMesh):
        return mesh.upper
    heights = mesh.nodes[:, 2]
    return np.flatnonzero(heights < heights.min() + TOLERANCE)
