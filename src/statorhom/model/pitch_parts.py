"""Which displacements of the half pitch carry coordinates, and which follow them.

Where a stator is its own mirror image about the middle of the core, its motions fall into two parts, and the lower
half of the half pitch carries the coordinates of both.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
import scipy.sparse as sp
from scipy.spatial import cKDTree

from statorhom.mesh.hex_mesh import HalfPitchMesh

Axial = Literal["even", "odd"]
TOLERANCE = 1e-9  # m: how far a node's mirror image may lie from another node
# what mirroring about the middle does to (u_r, u_θ, u_z) of the even and of the odd motions
_SIGNS: tuple[tuple[Axial, tuple[float, float, float]], ...] = (
    ("even", (1.0, 1.0, -1.0)),
    ("odd", (-1.0, -1.0, 1.0)),
)


@dataclass(frozen=True, eq=False)
class PitchPart:
    """Motions of one axial parity. Displacements are counted 3 node + direction.

    Parameters
    ----------
    axial : radial motion even or odd about the core's middle, None where the two ends differ.
    slots : N.
    source, sign : (3 n,) each displacement of the half pitch is `sign` (1, -1 or 0) times that of `source`.
    inner, tooth, slot : displacements that are sources: within the half pitch, on the tooth's and on the slot's plane.
    """

    axial: Axial | None
    slots: int
    source: np.ndarray
    sign: np.ndarray
    inner: np.ndarray
    tooth: np.ndarray
    slot: np.ndarray

    def fold(self, matrix: sp.csr_array) -> sp.csr_array:
        """A matrix of the half pitch (K or M) for the sources' displacements; the other rows are empty."""
        n = len(self.source)
        followed = sp.csr_array((self.sign, self.source, np.arange(n + 1)), shape=(n, n))
        return sp.csr_array(followed.T @ (matrix @ followed))


def pitch_parts(mesh: HalfPitchMesh) -> tuple[PitchPart, ...]:
    """The even and the odd part, or the one part of a stator whose ends differ."""
    n = len(mesh.nodes)
    own = np.arange(3 * n)
    image = _mirror_images(mesh)
    if image is None:
        return (_part(mesh, None, own, np.ones(3 * n)),)
    upper = mesh.nodes[:, 2] > mesh.length / 2 + TOLERANCE
    middle = image == np.arange(n)
    node = np.where(upper, image, np.arange(n))
    source = (3 * node[:, None] + np.arange(3)).ravel()
    parts = []
    for axial, signs in _SIGNS:
        sign = np.where(upper[:, None], signs, 1.0)
        # what would have to be its own opposite on the middle plane vanishes
        sign = np.where(middle[:, None] & (np.array(signs) < 0), 0.0, sign)
        parts.append(_part(mesh, axial, source, sign.ravel()))
    return tuple(parts)


def _part(mesh: HalfPitchMesh, axial: Axial | None, source: np.ndarray, sign: np.ndarray) -> PitchPart:
    node = np.arange(len(source)) // 3
    carries = (source == np.arange(len(source))) & (sign != 0)
    on_tooth, on_slot = (carries & np.isin(node, plane) for plane in (mesh.tooth_plane, mesh.slot_plane))
    inner = carries & ~on_tooth & ~on_slot
    return PitchPart(
        axial, mesh.slots, source, sign, *(np.flatnonzero(x) for x in (inner, on_tooth, on_slot))
    )


def _mirror_images(mesh: HalfPitchMesh) -> np.ndarray | None:
    """Node at the mirror image of each node about the core's middle, None where the ends differ."""
    # nodes of two parts may lie on each other
    part = np.full(len(mesh.nodes), len(mesh.regions))
    np.minimum.at(part, mesh.elements, mesh.region[:, None])
    tagged = np.column_stack([mesh.nodes, part])
    distance, image = cKDTree(tagged).query(tagged * [1.0, 1.0, -1.0, 1.0] + [0.0, 0.0, mesh.length, 0.0])
    if distance.max() > TOLERANCE or not _same_regions(mesh, image):
        return None
    return np.asarray(image)


def _same_regions(mesh: HalfPitchMesh, image: np.ndarray) -> bool:
    def signature(elements: np.ndarray) -> np.ndarray:
        rows = np.column_stack([np.sort(elements, axis=1), mesh.region])
        return rows[np.lexsort(rows.T)]

    return bool(np.array_equal(signature(mesh.elements), signature(image[mesh.elements])))
