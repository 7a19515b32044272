"""Elements' stiffness by height, for a stiffness that varies along the axis within an element too.

One of four elements along a core reaches over a quarter of it and more. If all of it had the stiffness of its middle, a
gradient would tilt shapes by a fifth less than it does.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from statorhom.mesh.hex_mesh import HalfPitchMesh
from statorhom.model.assembly import CHUNK, element_geometry, stiffness_of
from statorhom.model.broken.pieces import Pieces, element_dofs, elements_in
from statorhom.model.element import ShapeTable, gauss_table


@dataclass(frozen=True, eq=False)
class Heights:
    """Parts of some elements: what their Gauss points of one height contribute.

    Parameters
    ----------
    pieces : stiffness of every height, all heights of an element one after the other.
    z : (p,) where they lie (m).
    """

    pieces: Pieces
    z: np.ndarray


def stiffness_by_height(mesh: HalfPitchMesh, region: str, hooke: np.ndarray) -> Heights:
    """Stiffness of the elements of a region, its Gauss points of every height apart.

    Parameters
    ----------
    hooke : nine Hooke entries (Pa), or their change.
    """
    numbers = elements_in(mesh, (region,))
    tables = gauss_table().by_height()
    nodes = mesh.nodes[mesh.elements[numbers]]
    matrices = np.empty((len(numbers), len(tables), 60, 60))
    for k, table in enumerate(tables):
        for first in range(0, len(numbers), CHUNK):
            part = slice(first, first + CHUNK)
            matrices[part, k] = stiffness_of(element_geometry(nodes[part], table), hooke)
    dofs = np.repeat(element_dofs(mesh, numbers), len(tables), axis=0)
    pieces = Pieces(dofs, matrices.reshape(-1, 60, 60), 3 * len(mesh.nodes))
    return Heights(pieces, heights_of(nodes, tables).ravel())


def heights_of(nodes: np.ndarray, tables: tuple[ShapeTable, ...]) -> np.ndarray:
    """Where the points of some tables lie (m), (e, t), in elements whose node positions are `nodes` (e, 20, 3)."""
    return np.stack([(nodes[..., 2] @ table.values.T).mean(axis=1) for table in tables], axis=1)
