"""Mass matrix of point masses on a body."""

from __future__ import annotations

import numpy as np

from statorhom.mesh.hex_mesh import PointMasses
from statorhom.model.assembly import BlockPattern, node_blocks
from statorhom.model.element import shape_values


def lump_mass(pattern: BlockPattern, lumps: PointMasses) -> np.ndarray:
    """Block data (places, 3, 3) of m N Nᵀ, with N the shape functions at every lump (kg).

    Parameters
    ----------
    pattern : node couplings of the mesh.
    lumps : on its elements.
    """
    values = shape_values(lumps.places)
    numbers, row = np.unique(lumps.elements, return_inverse=True)
    along = np.zeros((len(numbers), 20, 20))
    np.add.at(along, row, lumps.masses[:, None, None] * values[:, :, None] * values[:, None, :])
    return pattern.part(numbers)(node_blocks(np.kron(along, np.eye(3))))
