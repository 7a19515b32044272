"""Matrices that act on a few displacements of the half pitch each: its elements, and the faces between its parts."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from statorhom.mesh.hex_mesh import HalfPitchMesh, HexMesh
from statorhom.model.assembly import CHUNK, ElementGeometry, element_geometry, mass_blocks, stiffness_of
from statorhom.model.element import gauss_table


@dataclass(frozen=True, eq=False)
class Pieces:
    """Symmetric matrices of parts of the half pitch.

    Parameters
    ----------
    dofs : (e, q) displacements that each matrix acts on.
    matrices : (e, q, q).
    size : displacements of the half pitch.
    """

    dofs: np.ndarray
    matrices: np.ndarray
    size: int

    def __post_init__(self) -> None:
        for array in (self.dofs, self.matrices):
            array.setflags(write=False)

    def __len__(self) -> int:
        return len(self.dofs)

    def matrix(self, weights: np.ndarray) -> sp.csr_array:
        """Σ w_e k_e on the half pitch."""
        values = self.matrices * weights[:, None, None]
        rows = np.broadcast_to(self.dofs[:, :, None], values.shape)
        columns = np.broadcast_to(self.dofs[:, None, :], values.shape)
        return sp.csr_array((values.ravel(), (rows.ravel(), columns.ravel())), shape=(self.size, self.size))

    def take(self, numbers: np.ndarray) -> Pieces:
        """Some of the pieces."""
        return Pieces(self.dofs[numbers], self.matrices[numbers], self.size)

    def alone(self) -> tuple[np.ndarray, Pieces]:
        """Displacements (d,) that they act on, and the pieces between these alone."""
        dofs, local = np.unique(self.dofs, return_inverse=True)
        return dofs, Pieces(local.reshape(self.dofs.shape), self.matrices, len(dofs))


def weighted_alike(weights: np.ndarray) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Numbers of pieces that have the same weights in all copies, and these (2 N,); without those that stay.

    Parameters
    ----------
    weights : (e, 2 N) per piece and half pitch.
    """
    used = np.flatnonzero(np.any(weights != 0.0, axis=1))
    patterns, member = np.unique(weights[used], axis=0, return_inverse=True)
    for i, pattern in enumerate(patterns):
        yield used[member.ravel() == i], pattern


def stiffness_pieces(mesh: HalfPitchMesh, hooke: Mapping[str, np.ndarray]) -> Pieces:
    """Stiffness of all elements of some regions.

    Parameters
    ----------
    hooke : region → nine Hooke entries (Pa), or their change (`statorhom.model.affine.hooke_coefficients`).
    """

    def blocks(region: str, geometry: ElementGeometry) -> np.ndarray:
        return stiffness_of(geometry, hooke[region])

    return _pieces(mesh, elements_in(mesh, hooke), blocks)


def mass_pieces(mesh: HalfPitchMesh, density: Mapping[str, float]) -> Pieces:
    """Mass of all elements of some regions.

    Parameters
    ----------
    density : region → density (kg/m³), or its change.
    """

    def blocks(region: str, geometry: ElementGeometry) -> np.ndarray:
        return density[region] * mass_blocks(geometry, gauss_table().values)

    return _pieces(mesh, elements_in(mesh, density), blocks)


def elements_in(mesh: HexMesh, regions: Mapping[str, object] | tuple[str, ...]) -> np.ndarray:
    """Ascending numbers of the elements of some regions: the order of their pieces."""
    return np.flatnonzero(np.isin(mesh.region, [mesh.regions.index(region) for region in regions]))


def _pieces(mesh: HalfPitchMesh, numbers: np.ndarray, blocks: object) -> Pieces:
    assert callable(blocks)
    matrices = np.empty((len(numbers), 60, 60))
    for i, region in enumerate(mesh.regions):
        places = np.flatnonzero(mesh.region[numbers] == i)
        for first in range(0, len(places), CHUNK):
            part = places[first : first + CHUNK]
            geometry = element_geometry(mesh.nodes[mesh.elements[numbers[part]]], gauss_table())
            matrices[part] = blocks(region, geometry)
    return Pieces(element_dofs(mesh, numbers), matrices, 3 * len(mesh.nodes))


def element_dofs(mesh: HexMesh, numbers: np.ndarray) -> np.ndarray:
    """Displacements (e, 60) of elements, given by their numbers."""
    return (3 * mesh.elements[numbers][:, :, None] + np.arange(3)).reshape(len(numbers), 60)
