"""Cuboids of 20-node hexahedra, numbered by their places on a grid of half cells."""

import numpy as np

from statorhom.mesh.hex_mesh import HexMesh
from statorhom.model.element import REFERENCE_NODES


def box_mesh(size, cells):
    """Cuboid from the origin to `size` (m) with `cells` along x, y, z."""
    place = np.rint(2 * REFERENCE_NODES).astype(int)
    corner = 2 * np.stack(np.meshgrid(*(np.arange(n) for n in cells), indexing="ij"), axis=-1).reshape(
        -1, 1, 3
    )
    points, elements = np.unique((corner + place).reshape(-1, 3), axis=0, return_inverse=True)
    nodes = points * np.asarray(size) / (2 * np.asarray(cells))
    return HexMesh(nodes, elements.reshape(-1, 20), np.zeros(len(corner), dtype=int), ("box",))


def turned(mesh, angle):
    """The mesh turned about z."""
    turn = np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]])
    return HexMesh(mesh.nodes @ turn.T, mesh.elements, mesh.region, mesh.regions)


def corners(mesh):
    """Numbers of a cuboid's eight corners."""
    ends = (mesh.nodes == mesh.nodes.min(axis=0)) | (mesh.nodes == mesh.nodes.max(axis=0))
    return np.flatnonzero(ends.all(axis=1))
