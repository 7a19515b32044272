"""Element matrices by batched products, assembled into one block pattern.

Displacements are the components at each node along the axes of a frame, usually the cylindrical (u_r, u_θ, u_z).
The finite-element space is that of Cartesian nodal displacements, but turning the stator by a slot pitch leaves
every number unchanged, and a material's axes are its natural ones at every Gauss point.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from statorhom.errors import SolverError
from statorhom.materials.rotation import stress_rotation
from statorhom.mesh.hex_mesh import HexMesh
from statorhom.model.element import ORDER, ShapeTable, gauss_table
from statorhom.model.frames import Frame, cylindrical

# the nine independent entries of an orthotropic Hooke's matrix, as (row, column) pairs
HOOKE_ENTRIES = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2), (3, 3), (4, 4), (5, 5))
PLACES = 200_000  # of the pattern at a time: bounds the memory of their summands to 50 MB
CHUNK = 256  # elements at a time: bounds the memory of the strain matrices to 70 MB


@dataclass(frozen=True)
class BlockPattern:
    """Sparsity of node couplings and where each element's blocks go.

    Parameters
    ----------
    indices, indptr : of the block sparse row format.
    order, starts : the blocks of all elements, sorted by place, and where each place begins.
    """

    indices: np.ndarray
    indptr: np.ndarray
    order: np.ndarray
    starts: np.ndarray

    def matrix(self, data: np.ndarray) -> sp.csr_array:
        """Sparse matrix of `data` (places, 3, 3)."""
        n = 3 * (len(self.indptr) - 1)
        return sp.csr_array(sp.bsr_array((data, self.indices, self.indptr), shape=(n, n)))

    def gather(self, blocks: np.ndarray) -> np.ndarray:
        """Sum element blocks (elements × 20 × 20, …) into their places (places, …)."""
        return np.add.reduceat(blocks[self.order], self.starts, axis=0)

    def gather_shared(self, blocks: np.ndarray, owner: np.ndarray, scale: np.ndarray) -> np.ndarray:
        """Sum blocks (k, 20, 20, 3, 3) that elements share: element e has those of `owner[e]` times `scale[e]`."""
        total = np.empty((len(self.starts), 3, 3))
        ends = np.r_[self.starts[1:], len(self.order)]
        for first in range(0, len(total), PLACES):
            last = min(first + PLACES, len(total)) - 1
            begin = self.starts[first]
            element, pair = np.divmod(self.order[begin : ends[last]], 400)
            summands = blocks.reshape(-1, 400, 3, 3)[owner[element], pair]
            summands *= scale[element][:, None, None]
            np.add.reduceat(summands, self.starts[first : last + 1] - begin, out=total[first : last + 1])
        return total

    def part(self, elements: np.ndarray) -> PartialGather:
        """What sums the blocks of some elements only, given by their ascending numbers."""
        number = np.full(int(self.order.max()) // 400 + 1, -1)
        number[elements] = np.arange(len(elements))
        kept = number[self.order // 400] >= 0
        order = number[self.order[kept] // 400] * 400 + self.order[kept] % 400
        counts = np.diff(np.r_[self.starts, len(self.order)])
        place = np.repeat(np.arange(len(self.starts)), counts)[kept]
        starts = np.flatnonzero(np.r_[True, place[1:] != place[:-1]])
        return PartialGather(order, starts, place[starts], len(self.starts))


@dataclass(frozen=True)
class PartialGather:
    """Order in which the blocks of some elements are summed, and the places that they fill."""

    order: np.ndarray
    starts: np.ndarray
    places: np.ndarray
    count: int

    def __call__(self, blocks: np.ndarray) -> np.ndarray:
        """Blocks (elements · 400, 3, 3) of these elements summed into all places (count, 3, 3)."""
        total = np.zeros((self.count, *blocks.shape[1:]))
        total[self.places] = self.summed(blocks)
        return total

    def summed(self, blocks: np.ndarray) -> np.ndarray:
        """The same at the places that are filled alone."""
        return np.asarray(np.add.reduceat(blocks[self.order], self.starts, axis=0))


def block_pattern(elements: np.ndarray, n_nodes: int) -> BlockPattern:
    """Pattern of all couplings between nodes that share an element."""
    rows = np.repeat(elements, 20, axis=1).ravel()
    columns = np.tile(elements, (1, 20)).ravel()
    place = rows * n_nodes + columns
    order = np.argsort(place, kind="stable")
    place = place[order]
    starts = np.flatnonzero(np.r_[True, place[1:] != place[:-1]])
    unique = place[starts]
    indptr = np.searchsorted(unique // n_nodes, np.arange(n_nodes + 1))
    return BlockPattern(unique % n_nodes, indptr, order, starts)


@dataclass(frozen=True)
class ElementGeometry:
    """Geometry of a chunk of elements at its Gauss points.

    Parameters
    ----------
    volume : (e, q) weights times Jacobian determinant (m³).
    gradients : (e, q, 20, 3) shape-function gradients along the frame's axes at the Gauss point (1/m).
    turn : (e, q, 20) angle from the Gauss point's axes to each node's (rad).
    """

    volume: np.ndarray
    gradients: np.ndarray
    turn: np.ndarray


def element_geometry(nodes: np.ndarray, table: ShapeTable, frame: Frame = cylindrical) -> ElementGeometry:
    """Isoparametric map of elements whose node positions are `nodes` (e, 20, 3).

    Raises
    ------
    SolverError
        If an element is turned inside out.
    """
    jacobian = np.einsum("eai,qaj->eqij", nodes, table.gradients)
    determinant = np.linalg.det(jacobian)
    if determinant.min() <= 0:
        raise SolverError(
            "the mesh has an element that is turned inside out; check the geometry for needle-like parts"
        )
    cartesian = table.gradients[None] @ np.linalg.inv(jacobian)
    position = np.einsum("qa,eai->eqi", table.values, nodes)
    angle = frame(position)
    cos, sin = np.cos(angle)[..., None], np.sin(angle)[..., None]
    gx, gy, gz = np.moveaxis(cartesian, -1, 0)
    local = np.stack([cos * gx + sin * gy, cos * gy - sin * gx, gz], axis=-1)
    turn = np.remainder(frame(nodes)[:, None, :] - angle[..., None] + np.pi, 2 * np.pi) - np.pi
    return ElementGeometry(table.weights * determinant, local, turn)


def strain_matrix(g: ElementGeometry) -> np.ndarray:
    """Strain (Voigt 11, 22, 33, 23, 13, 12) of nodal displacements in the frame's components, (e, q, 6, 60)."""
    cos, sin = np.cos(g.turn), np.sin(g.turn)
    g1, g2, g3 = np.moveaxis(g.gradients, -1, 0)
    zero = np.zeros_like(g1)
    # columns are u_1, u_2, u_3 of a node; in the Gauss point's axes u_1 contributes (cos, sin), u_2 (-sin, cos)
    rows = [
        (g1 * cos, -g1 * sin, zero),
        (g2 * sin, g2 * cos, zero),
        (zero, zero, g3),
        (g3 * sin, g3 * cos, g2),
        (g3 * cos, -g3 * sin, g1),
        (g2 * cos + g1 * sin, -g2 * sin + g1 * cos, zero),
    ]
    stacked = np.stack([np.stack(row, axis=-1) for row in rows], axis=2)
    return stacked.reshape(*stacked.shape[:3], 60)


def stiffness_blocks(g: ElementGeometry, axes: np.ndarray | None = None) -> Iterator[np.ndarray]:
    """Element stiffness per unit Hooke entry, in the order of `HOOKE_ENTRIES`, each (e, 60, 60).

    Parameters
    ----------
    axes : (e, 3, 3) of the materials as columns, in components of the frame; None where they are the frame's.
    """
    strain = strain_matrix(g)
    if axes is not None:
        # what turns stresses one way turns strains the other: εᵀ (N C Nᵀ) ε = (Nᵀ ε)ᵀ C (Nᵀ ε)
        strain = np.swapaxes(stress_rotation(axes), -1, -2)[:, None] @ strain
    weighted = strain * g.volume[..., None, None]
    for i, j in HOOKE_ENTRIES:
        block = weighted[:, :, i].transpose(0, 2, 1) @ strain[:, :, j]
        yield block if i == j else block + block.transpose(0, 2, 1)


def stiffness_of(g: ElementGeometry, hooke: np.ndarray) -> np.ndarray:
    """Element stiffness of nine Hooke entries, or of their change, (e, 60, 60)."""
    terms = zip(hooke, stiffness_blocks(g), strict=True)
    return np.asarray(sum(factor * block for factor, block in terms))


def elastic_blocks(g: ElementGeometry, hooke: np.ndarray) -> np.ndarray:
    """Element stiffness of a material with any Hooke's matrix (6, 6), (e, 60, 60)."""
    strain = strain_matrix(g)
    stress = (hooke @ strain) * g.volume[..., None, None]
    e = len(strain)
    return stress.reshape(e, -1, 60).transpose(0, 2, 1) @ strain.reshape(e, -1, 60)


def mass_blocks(g: ElementGeometry, values: np.ndarray) -> np.ndarray:
    """Element mass per unit density, (e, 60, 60)."""
    cos, sin = np.cos(g.turn), np.sin(g.turn)
    zero = np.zeros_like(cos)
    one = np.broadcast_to(values, cos.shape)
    motion = np.stack(
        [
            np.stack([one * cos, -one * sin, zero], axis=-1),
            np.stack([one * sin, one * cos, zero], axis=-1),
            np.stack([zero, zero, one], axis=-1),
        ],
        axis=2,
    )
    flat = motion.reshape(*motion.shape[:3], 60)
    weighted = flat * g.volume[..., None, None]
    e = len(flat)
    return weighted.reshape(e, -1, 60).transpose(0, 2, 1) @ flat.reshape(e, -1, 60)


def node_blocks(matrices: np.ndarray) -> np.ndarray:
    """Split element matrices (e, 60, 60) into node blocks (e·400, 3, 3)."""
    e = len(matrices)
    return matrices.reshape(e, 20, 3, 20, 3).transpose(0, 1, 3, 2, 4).reshape(-1, 3, 3)


def chunks(
    mesh: HexMesh, region: int, frame: Frame = cylindrical, order: int = ORDER
) -> Iterator[tuple[np.ndarray, ElementGeometry]]:
    """Element numbers and geometry of a region, a chunk at a time, at Gauss points of an order (`gauss_table`)."""
    numbers = np.flatnonzero(mesh.region == region)
    for first in range(0, len(numbers), CHUNK):
        part = numbers[first : first + CHUNK]
        yield part, element_geometry(mesh.nodes[mesh.elements[part]], gauss_table(order), frame)


def region_volumes(mesh: HexMesh) -> dict[str, float]:
    """Volume of each region of a mesh (m³), integrated over its elements."""
    return {
        name: sum(float(g.volume.sum()) for _, g in chunks(mesh, i)) for i, name in enumerate(mesh.regions)
    }
