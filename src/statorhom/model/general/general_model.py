"""A body of any shape: stiffness, mass and modes of a whole mesh.

Unlike the cyclic model it asks for no symmetry: every element may have a region and a stiffness factor of its own,
and springs and masses may sit anywhere. K is linear in the Hooke entries here too, but its terms would take nine
times K's memory: it is assembled from the materials directly, as fast as one term.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sp

from statorhom.errors import MaterialError, SolverError
from statorhom.mesh.hex_mesh import HalfPitchMesh, HexMesh
from statorhom.model.affine import Materials
from statorhom.model.assembly import (
    CHUNK,
    BlockPattern,
    ElementGeometry,
    block_pattern,
    elastic_blocks,
    element_geometry,
    mass_blocks,
)
from statorhom.model.back_ends.choice import best_available
from statorhom.model.eigen import Factorize
from statorhom.model.element import gauss_table
from statorhom.model.frames import Frame, cylindrical
from statorhom.model.general.band import EXPECTED, GeneralModes, band_modes


@dataclass(frozen=True)
class GeneralModel:
    """A whole mesh before its materials are known; made by `general_model` or `whole_ring`.

    Parameters
    ----------
    mesh : the mesh.
    frame : axes of the nodes' displacements and of the materials.
    pattern : node couplings.
    prototype : (m,) the element whose geometry, seen in the frame, each element has (its own number if none).
    added_stiffness, added_mass : (3 n, 3 n) springs (N/m) and lumps (kg) beside the elements.
    """

    mesh: HexMesh
    frame: Frame
    pattern: BlockPattern
    prototype: np.ndarray
    added_stiffness: sp.csr_array
    added_mass: sp.csr_array

    @property
    def size(self) -> int:
        """Degrees of freedom."""
        return 3 * len(self.mesh.nodes)

    def with_region(self, name: str, elements: np.ndarray) -> GeneralModel:
        """The model with some elements, by number or mask, in a (new) region: a strip, an arc or a box."""
        return replace(self, mesh=self.mesh.with_region(name, elements))

    def with_added(self, stiffness: sp.sparray | None = None, mass: sp.sparray | None = None) -> GeneralModel:
        """The model with further springs and lumps, symmetric (3 n, 3 n) in the frame's components."""
        K, M = self.added_stiffness, self.added_mass
        return replace(
            self,
            added_stiffness=K if stiffness is None else sp.csr_array(K + stiffness),
            added_mass=M if mass is None else sp.csr_array(M + mass),
        )

    def stiffness_matrix(self, materials: Materials, element_scale: np.ndarray | None = None) -> sp.csr_array:
        """K (N/m), springs included.

        Parameters
        ----------
        materials : of every region that has elements; any Hooke's matrix in the frame's axes.
        element_scale : (m,) factors ≥ 0 of the elements' stiffness, springs left as they are.

        Raises
        ------
        MaterialError
            If a factor is negative or not a number, or if their number is not that of the elements.
        """
        scale = (
            np.ones(len(self.mesh.elements)) if element_scale is None else np.asarray(element_scale, float)
        )
        if scale.shape != (len(self.mesh.elements),) or not np.all((scale >= 0) & np.isfinite(scale)):
            raise MaterialError(
                f"element_scale: needs one number ≥ 0 for each of the {len(self.mesh.elements)} elements"
            )
        blocks, owner = self._shared_blocks(lambda g, name: elastic_blocks(g, materials[name].hooke.matrix))
        K = self.pattern.matrix(self.pattern.gather_shared(blocks, owner, scale))
        return sp.csr_array(K + self.added_stiffness)

    def mass_matrix(self, materials: Materials) -> sp.csr_array:
        """M (kg), lumps included."""
        values = gauss_table().values
        blocks, owner = self._shared_blocks(lambda g, name: materials[name].density * mass_blocks(g, values))
        M = self.pattern.matrix(self.pattern.gather_shared(blocks, owner, np.ones(len(owner))))
        return sp.csr_array(M + self.added_mass)

    def solve(
        self,
        highest_hz: float,
        materials: Materials,
        back_end: Factorize | None = None,
        element_scale: np.ndarray | None = None,
        expected: int = EXPECTED,
    ) -> GeneralModes:
        """All modes up to a frequency.

        Parameters
        ----------
        highest_hz : upper end of the band.
        materials, element_scale : see `stiffness_matrix`.
        back_end : factorizes K + σ M; the best that is installed if None.
        expected : how many modes to ask for first; doubled until the band is covered.

        Raises
        ------
        SolverError
            If K + σ M is not positive definite, or if the iteration does not converge.
        """
        K, M = self.stiffness_matrix(materials, element_scale), self.mass_matrix(materials)
        return band_modes(K, M, highest_hz, back_end or best_available(), expected)

    def _shared_blocks(
        self, matrices: Callable[[ElementGeometry, str], np.ndarray]
    ) -> tuple[np.ndarray, np.ndarray]:
        """Element matrices (k, 20, 20, 3, 3) of each prototype in each region, and which an element has."""
        mesh, table = self.mesh, gauss_table()
        kind = self.prototype * len(mesh.regions) + mesh.region
        kinds, owner = np.unique(kind, return_inverse=True)
        prototype, region = np.divmod(kinds, len(mesh.regions))
        blocks = np.empty((len(kinds), 20, 20, 3, 3))
        for i in np.unique(region):
            numbers = np.flatnonzero(region == i)
            for part in np.split(numbers, range(CHUNK, len(numbers), CHUNK)):
                geometry = element_geometry(mesh.nodes[mesh.elements[prototype[part]]], table, self.frame)
                found = matrices(geometry, mesh.regions[i])
                blocks[part] = found.reshape(-1, 20, 3, 20, 3).transpose(0, 1, 3, 2, 4)
        return blocks, owner


def general_model(mesh: HexMesh, frame: Frame = cylindrical) -> GeneralModel:
    """Model of any mesh.

    Parameters
    ----------
    mesh : of 20-node hexahedra.
    frame : axes of displacements and materials, `frames.cylindrical` or `frames.cartesian`.

    Raises
    ------
    SolverError
        If a node belongs to no element: nothing would hold it.
    """
    if not np.array_equal(np.unique(mesh.elements), np.arange(len(mesh.nodes))):
        raise SolverError("the mesh has nodes that belong to no element; leave them out of it")
    return _model(mesh, frame, np.arange(len(mesh.elements)))


def whole_ring(half: HalfPitchMesh) -> GeneralModel:
    """Model of the whole stator in cylindrical components.

    Its pitches are turned copies, alike in these components: element matrices are computed for one of them.
    """
    mesh, _, _ = half.full()
    return _model(mesh, cylindrical, np.arange(len(mesh.elements)) % (2 * len(half.elements)))


def _model(mesh: HexMesh, frame: Frame, prototype: np.ndarray) -> GeneralModel:
    size = 3 * len(mesh.nodes)
    nothing = sp.csr_array((size, size))
    pattern = block_pattern(mesh.elements, len(mesh.nodes))
    return GeneralModel(mesh, frame, pattern, prototype, nothing, nothing)
