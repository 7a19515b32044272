"""A contact of zero thickness between two parts: the mesh is split along it and springs join its two sides.

The intact contact is part of the symmetric stator (`symmetric_basis(…, contact=…)`); where it is lost over an arc its
pieces change (`statorhom.model.broken.variations.arc`).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sp
from skfem import ElementQuad2
from skfem.quadrature import get_quadrature

from statorhom.errors import SolverError
from statorhom.mesh.hex_mesh import HalfPitchMesh, HexMesh
from statorhom.model.broken.pieces import Pieces
from statorhom.model.element import REFERENCE_NODES, shape_functions

# the six faces of an element: four corners, then the mid-sides between them
FACES = np.array(
    [
        [0, 1, 2, 3, 8, 9, 10, 11],
        [4, 5, 6, 7, 16, 17, 18, 19],
        [0, 1, 5, 4, 8, 13, 16, 12],
        [1, 2, 6, 5, 9, 14, 17, 13],
        [2, 3, 7, 6, 10, 15, 18, 14],
        [3, 0, 4, 7, 11, 12, 19, 15],
    ]
)
GRID = 1e-9  # m: nodes closer than this lie on each other


def split(mesh: HalfPitchMesh, regions: tuple[str, ...]) -> HalfPitchMesh:
    """The mesh whose `regions` have nodes of their own where they touch the others."""
    inside = np.isin(mesh.region, [mesh.regions.index(region) for region in regions])
    shared = np.intersect1d(mesh.elements[inside], mesh.elements[~inside])
    number = np.arange(len(mesh.nodes))
    number[shared] = len(mesh.nodes) + np.arange(len(shared))
    elements = mesh.elements.copy()
    elements[inside] = number[elements[inside]]

    def both(plane: np.ndarray) -> np.ndarray:
        return np.concatenate([plane, number[np.intersect1d(plane, shared)]])

    return replace(
        mesh,
        nodes=np.vstack([mesh.nodes, mesh.nodes[shared]]),
        elements=elements,
        tooth_plane=both(mesh.tooth_plane),
        slot_plane=both(mesh.slot_plane),
    )


@dataclass(frozen=True, eq=False)
class Contact:
    """Springs over the faces between two parts.

    Parameters
    ----------
    pieces : one per face.
    angle : (f, 2) lower and upper angle of each face (rad).
    """

    pieces: Pieces
    angle: np.ndarray

    @property
    def matrix(self) -> sp.csr_array:
        """Stiffness of the intact contact."""
        return self.pieces.matrix(np.ones(len(self.pieces)))


def contact(mesh: HexMesh, regions: tuple[str, ...], normal: float, tangential: float) -> Contact:
    """Contact of some regions of a split mesh with the others.

    Parameters
    ----------
    regions : those that `split` gave nodes of their own.
    normal, tangential : stiffness per area (N/m³).

    Raises
    ------
    SolverError
        If the regions have no nodes of their own on a face of another part.
    """
    inside = np.isin(mesh.region, [mesh.regions.index(region) for region in regions])
    mine, others = (mesh.elements[side][:, FACES] for side in (inside, ~inside))
    _, place = np.unique(np.round(mesh.nodes / GRID).astype(np.int64), axis=0, return_inverse=True)
    opposite = {tuple(np.sort(place.ravel()[face])): face for face in others.reshape(-1, 8)}
    pairs = []
    for faces in mine:
        for kind, face in enumerate(faces):
            twin = opposite.get(tuple(np.sort(place.ravel()[face])))
            if twin is not None and not np.array_equal(np.sort(twin), np.sort(face)):
                order = {place.ravel()[node]: node for node in twin}
                pairs.append((kind, face, [order[place.ravel()[node]] for node in face]))
    if not pairs:
        raise SolverError(
            f"the regions {', '.join(regions)} touch no other part with nodes of their own; split the mesh first"
        )
    kinds, left, right = (np.array(column) for column in zip(*pairs, strict=True))
    matrices = np.empty((len(kinds), 48, 48))
    for kind in np.unique(kinds):
        here = kinds == kind
        matrices[here] = _face_matrices(mesh.nodes[left[here]], FACES[kind], normal, tangential)
    dofs = (3 * np.hstack([left, right])[:, :, None] + np.arange(3)).reshape(len(kinds), 48)
    corners = mesh.nodes[left[:, :4]]
    angle = np.arctan2(corners[..., 1], corners[..., 0])
    return Contact(
        Pieces(dofs, matrices, 3 * len(mesh.nodes)), np.stack([angle.min(axis=1), angle.max(axis=1)], axis=1)
    )


def _face_matrices(nodes: np.ndarray, local: np.ndarray, normal: float, tangential: float) -> np.ndarray:
    """Springs (f, 48, 48) against the jump between the two sides of faces at `nodes` (f, 8, 3)."""
    points, weights = get_quadrature(ElementQuad2, 6)
    origin, along, up = (REFERENCE_NODES[local[i]] for i in (0, 1, 3))
    along, up = along - origin, up - origin
    values, gradients = shape_functions(origin + np.outer(points[0], along) + np.outer(points[1], up))
    values = values[:, local]
    tangents = [np.einsum("qa,fai->fqi", gradients[:, local] @ axis, nodes) for axis in (along, up)]
    area = np.cross(*tangents)
    size = np.linalg.norm(area, axis=-1)
    position = np.einsum("qa,fai->fqi", values, nodes)
    angle = np.arctan2(position[..., 1], position[..., 0])
    cos, sin = np.cos(angle), np.sin(angle)
    x, y, z = np.moveaxis(area / size[..., None], -1, 0)
    # the normal in the axes of the point, which the jump is turned into
    axis = np.stack([cos * x + sin * y, cos * y - sin * x, z], axis=-1)
    springs = tangential * np.eye(3) + (normal - tangential) * axis[..., :, None] * axis[..., None, :]
    turn = np.arctan2(nodes[..., 1], nodes[..., 0])[:, None, :] - angle[..., None]
    motion = np.zeros((*turn.shape[:2], 3, 8, 3))
    motion[..., 0, :, 0] = motion[..., 1, :, 1] = values * np.cos(turn)
    motion[..., 1, :, 0] = values * np.sin(turn)
    motion[..., 0, :, 1] = -motion[..., 1, :, 0]
    motion[..., 2, :, 2] = values
    flat = motion.reshape(*turn.shape[:2], 3, 24)
    jump = np.concatenate([flat, -flat], axis=-1)
    weighted = np.einsum("fq,fqij,fqjb->fqib", size * weights, springs, jump)
    return np.asarray(np.einsum("fqia,fqib->fab", jump, weighted))
