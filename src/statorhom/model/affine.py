"""Stiffness and mass of half a slot pitch or of another symmetric part, affine in the Hooke entries and the densities.

K = Σ over regions and entries of θ_q(C) K_q exactly, M = Σ ρ M_region; every K_q is assembled once per mesh.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Generic, cast

import numpy as np
import scipy.sparse as sp
from typing_extensions import TypeVar

from statorhom.errors import MaterialError
from statorhom.materials.hooke import Hooke
from statorhom.mesh.hex_mesh import HalfPitchMesh, PartMesh
from statorhom.model.assembly import (
    HOOKE_ENTRIES,
    BlockPattern,
    block_pattern,
    chunks,
    element_geometry,
    mass_blocks,
    node_blocks,
    stiffness_blocks,
)
from statorhom.model.element import ORDER, gauss_table
from statorhom.model.frames import FRAMES
from statorhom.model.point_masses import lump_mass
from statorhom.study.wing_file import LUMPS


@dataclass(frozen=True)
class Material:
    """Hooke's matrix in the axes of the model's frame (Pa) and density (kg/m³) of a region."""

    hooke: Hooke
    density: float


Materials = Mapping[str, Material]
_ROWS, _COLUMNS = np.array(HOOKE_ENTRIES).T


@lru_cache(maxsize=4096)
def hooke_coefficients(hooke: Hooke) -> np.ndarray:
    """The nine entries C11, C22, C33, C12, C13, C23, C44, C55, C66 (Pa).

    Raises
    ------
    MaterialError
        If the material is not orthotropic in the axes of the part: such a body has no mirror symmetry.
    """
    matrix = hooke.matrix
    rest = matrix.copy()
    rest[_ROWS, _COLUMNS] = rest[_COLUMNS, _ROWS] = 0.0
    if np.abs(rest).max() > 1e-9 * np.abs(matrix).max():
        raise MaterialError("a region's material must be orthotropic with its axes along r, θ and z")
    found = matrix[_ROWS, _COLUMNS]
    found.setflags(write=False)
    return np.asarray(found)


# unless said otherwise, a stator's
Mesh = TypeVar("Mesh", bound=PartMesh, default=HalfPitchMesh, covariant=True)
_Mesh = TypeVar("_Mesh", bound=PartMesh)


@dataclass(frozen=True, eq=False)
class RegionStiffness:
    """Stiffness of one region per unit Hooke entry, at the places of the pattern that it touches.

    Parameters
    ----------
    places : (p,) their numbers.
    blocks : (9, p, 3, 3) block data (m).
    """

    places: np.ndarray
    blocks: np.ndarray

    def add(self, coefficients: np.ndarray, data: np.ndarray) -> None:
        """Add the stiffness at nine Hooke entries to block data (places, 3, 3) of the whole pattern."""
        data[self.places] += np.tensordot(coefficients, self.blocks, axes=1)


@dataclass(frozen=True, eq=False)
class AffineModel(Generic[Mesh]):
    """A symmetric body's part before its materials are known.

    Parameters
    ----------
    mesh : of the part.
    pattern : node couplings.
    stiffness : region → what it contributes to K; lumps have none.
    mass : region → (places, 3, 3) block data per unit density (m³); of lumps for their own masses (kg).
    volumes : region → volume in the whole body's mesh (m³); of lumps their mass (kg), for their density is 1.
    """

    mesh: Mesh
    pattern: BlockPattern
    stiffness: Mapping[str, RegionStiffness]
    mass: Mapping[str, np.ndarray]
    volumes: Mapping[str, float]

    @property
    def size(self) -> int:
        """Degrees of freedom of the part."""
        return 3 * len(self.mesh.nodes)

    def stiffness_matrix(self, materials: Materials) -> sp.csr_array:
        """K of the part (N/m)."""
        return self.pattern.matrix(
            self.stiffness_data({r: hooke_coefficients(materials[r].hooke) for r in self.stiffness})
        )

    def stiffness_data(self, coefficients: Mapping[str, np.ndarray]) -> np.ndarray:
        """Block data (places, 3, 3) of K at nine Hooke entries of some regions."""
        data = np.zeros((len(self.pattern.indices), 3, 3))
        for region, entries in coefficients.items():
            self.stiffness[region].add(entries, data)
        return data

    def region_stiffness(self, region: str, material: Material) -> sp.csr_array:
        """Contribution of one region to K (N/m)."""
        return self.pattern.matrix(self.stiffness_data({region: hooke_coefficients(material.hooke)}))

    def mass_matrix(self, materials: Materials) -> sp.csr_array:
        """M of the part (kg)."""
        return self.pattern.matrix(self.mass_data({r: materials[r].density for r in self.mass}))

    def mass_data(self, densities: Mapping[str, float]) -> np.ndarray:
        """Block data (places, 3, 3) of M at the densities of all regions (kg/m³)."""
        return np.asarray(sum(densities[region] * blocks for region, blocks in self.mass.items()))

    def stiffness_term(self, region: str, entry: int) -> sp.csr_array:
        """K_q of one Hooke entry (index into `HOOKE_ENTRIES`) of one region."""
        return self.pattern.matrix(self.stiffness_data({region: np.eye(len(HOOKE_ENTRIES))[entry]}))

    def mass_term(self, region: str) -> sp.csr_array:
        """M per unit density of one region."""
        return self.pattern.matrix(self.mass[region])


def stator_model(model: AffineModel[PartMesh]) -> AffineModel:
    """The same model where it can only be a stator's or a tube's.

    Raises
    ------
    TypeError
        If it is of another body.
    """
    if not isinstance(model.mesh, HalfPitchMesh):
        raise TypeError(type(model.mesh))
    return cast(AffineModel, model)


def assemble(mesh: _Mesh) -> AffineModel[_Mesh]:
    """Assemble all affine terms of a mesh."""
    pattern = block_pattern(mesh.elements, len(mesh.nodes))
    stiffness, mass, volumes = {}, {}, {}
    for i, name in enumerate(mesh.regions):
        if name == LUMPS:
            continue
        stiffness[name], mass[name], half = _region_terms(mesh, pattern, i)
        volumes[name] = mesh.copies * half
    lumps = mesh.point_masses()
    if lumps is not None:
        mass[LUMPS] = lump_mass(pattern, lumps)
        volumes[LUMPS] = mesh.copies * float(lumps.masses.sum())
    return AffineModel(mesh, pattern, stiffness, mass, volumes)


def _region_terms(
    mesh: PartMesh, pattern: BlockPattern, region: int
) -> tuple[RegionStiffness, np.ndarray, float]:
    """Stiffness, mass and volume of one region; only its own elements are summed."""
    gather = pattern.part(np.flatnonzero(mesh.region == region))
    stiffness: list[list[np.ndarray]] = [[] for _ in HOOKE_ENTRIES]
    mass = []
    volume = 0.0
    frame = FRAMES[mesh.axes]
    for numbers, geometry in chunks(mesh, region, frame):
        elastic = geometry
        if mesh.quadrature != ORDER:
            elastic = element_geometry(
                mesh.nodes[mesh.elements[numbers]], gauss_table(mesh.quadrature), frame
            )
        for term, matrices in zip(stiffness, stiffness_blocks(elastic, mesh.cell_axes(numbers)), strict=True):
            term.append(node_blocks(matrices))
        mass.append(node_blocks(mass_blocks(geometry, gauss_table().values)))
        volume += float(geometry.volume.sum())
    terms = np.stack([gather.summed(np.concatenate(term)) for term in stiffness])
    return RegionStiffness(gather.places, terms), gather(np.concatenate(mass)), volume
