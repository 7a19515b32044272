"""What a point of a body yields beyond the modes of a basis: without it a lump at a corner would sit too firmly.

A unit force on a point bends the body statically; freed of the modes of the basis this leaves one local shape per
direction. Its stiffness, its mass and the motion of the point are three numbers that vary smoothly over the surface, so
that a lump or a spring anywhere takes its own local shapes with it (Rubin's residual attachment modes).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import numpy.typing as npt
from scipy.interpolate import LinearNDInterpolator, NearestNDInterpolator

from statorhom.mesh.mirror_mesh import MirrorMesh
from statorhom.model.affine import AffineModel, Materials
from statorhom.model.back_ends.sturdy import sturdy
from statorhom.model.eigen import SHIFT
from statorhom.model.modal.surface_motion import image_of, outer_nodes
from statorhom.model.problems import spaces_of

FloatArray = npt.NDArray[np.float64]

LEAST, MOST = 30, 160  # points at which it is computed
WORK = 2_000_000  # points times coordinates of the part: what a solve costs goes with its size


@dataclass(frozen=True, eq=False)
class PointResiduals:
    """Local shapes of points on the surface, by direction.

    Parameters
    ----------
    mesh : of the part.
    plan : (n, 2) points of the part, seen from above.
    yields : (n, 3) motion of the point in its local shape per unit force (m/N).
    inertia : (n, 3) mass of the local shape per square of a unit force (kg m²/N²).
    """

    mesh: MirrorMesh
    plan: FloatArray
    yields: FloatArray
    inertia: FloatArray

    def at(self, places: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Yields and inertia (p, 3) of places (p, 3)."""
        image, _ = image_of(self.mesh, places)
        found = np.asarray(self._inside(image[:, :2]))
        outside = np.isnan(found).any(axis=1)
        found[outside] = self._nearest(image[outside, :2])
        return found[:, :3], found[:, 3:]

    def softened(self, ratio: float) -> PointResiduals:
        """Those of the same body of materials that yield more by a factor."""
        return replace(self, yields=ratio * self.yields, inertia=ratio**2 * self.inertia)

    @cached_property
    def _inside(self) -> LinearNDInterpolator:
        return LinearNDInterpolator(self.plan, np.hstack([self.yields, self.inertia]), rescale=True)

    @cached_property
    def _nearest(self) -> NearestNDInterpolator:
        return NearestNDInterpolator(self.plan, np.hstack([self.yields, self.inertia]))


def point_residuals(
    model: AffineModel[MirrorMesh],
    materials: Materials,
    shapes: FloatArray,
    parities: npt.NDArray[np.int_],
    highest_hz: float,
) -> PointResiduals:
    """Local shapes of many points.

    Parameters
    ----------
    model, materials : the body.
    shapes, parities : of the basis; modes of unit mass at these materials come first in each parity.
    highest_hz : end of the band.
    """
    mesh = model.mesh
    every = outer_nodes(mesh)
    count = min(len(every), max(LEAST, min(MOST, WORK // (3 * len(mesh.nodes)))))
    nodes = every[np.linspace(0, len(every) - 1, count).round().astype(int)]
    K, M = model.stiffness_matrix(materials), model.mass_matrix(materials)
    sigma = SHIFT * (2 * np.pi * highest_hz) ** 2  # rigid bodies are in the basis: small beside what is not
    yields, inertia = np.zeros((len(nodes), 3)), np.zeros((len(nodes), 3))
    for order in np.unique(parities):
        [space] = spaces_of(mesh, int(order))
        K_p, M_p = space.project(K), space.project(M)
        solve = sturdy(K_p + sigma * M_p)
        place = np.full(3 * len(mesh.nodes), -1)
        place[space.free] = np.arange(space.size)  # type: ignore[attr-defined]
        known = shapes[:, parities == order][space.free]  # type: ignore[attr-defined]
        images = space.copies * (M_p @ known)
        for axis in range(3):
            rows = place[3 * nodes + axis]
            moves = np.flatnonzero(rows >= 0)
            load = np.zeros((space.size, len(moves)))
            load[rows[moves], np.arange(len(moves))] = 1.0
            load -= images @ known[rows[moves]].T
            local = solve(load)
            local -= known @ (images.T @ local)
            yields[moves, axis] += local[rows[moves], np.arange(len(moves))] / space.copies
            inertia[moves, axis] += np.einsum("ij,ij->j", local, M_p @ local) / space.copies
    return PointResiduals(mesh, mesh.nodes[nodes, :2], yields, inertia)
