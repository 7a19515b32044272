"""One harmonic problem of the symmetric stator, and how its outer surface answers static loads."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.sparse as sp

from statorhom.mesh.hex_mesh import HalfPitchMesh
from statorhom.model.cyclic.problem import CyclicProblem, ProblemMatrix
from statorhom.model.cyclic.unit_loads import LoadedProblem, UnitLoads
from statorhom.model.eigen import Solve
from statorhom.model.harmonic import Harmonic
from statorhom.model.surface import TOLERANCE, surface_radius


@dataclass(frozen=True, eq=False)
class Sector:
    """A harmonic problem.

    Parameters
    ----------
    problem : of one harmonic.
    unit : loads on the displacements of the half pitch that lie on the outer surface.
    """

    problem: CyclicProblem
    unit: UnitLoads

    @property
    def surface(self) -> np.ndarray:
        """Displacements of the half pitch that lie on the outer surface, ascending."""
        return self.unit.displacements

    @property
    def space(self) -> Harmonic:
        """Its coordinates."""
        return self.problem.space

    @property
    def K(self) -> ProblemMatrix:
        """Stiffness, times the copies, so that yᵀKy is the whole stator's."""
        return self.problem.K

    @property
    def M(self) -> ProblemMatrix:
        """Mass."""
        return self.problem.M

    @property
    def shift(self) -> float:
        """σ of the static responses (rad²/s²)."""
        return self.problem.shifted.shift

    @property
    def families(self) -> tuple[bool, ...]:
        """The shapes of a column: False for the cosine, True for the sine family."""
        return {"pair": (False, True), "even": (False,), "odd": (True,)}[self.space.parity]

    @property
    def solve(self) -> Solve:
        """(K + σM)⁻¹."""
        return self.problem.solve

    @cached_property
    def trace(self) -> sp.csr_array:
        """(d, m) complex sparse: displacements of the surface by the coordinates."""
        return sp.csr_array(self.space.real[self.surface] + 1j * self.space.imaginary[self.surface])

    @cached_property
    def loaded(self) -> np.ndarray:
        """Coordinates that move the surface."""
        return np.unique(self.trace.indices)

    @property
    def surface_trace(self) -> sp.csr_array:
        """(s, 3 n) complex sparse: displacements of the half pitch by the loaded coordinates, transposed."""
        moved = sp.coo_array(self.trace[:, self.loaded].T)
        size = self.space.real.shape[0]
        return sp.csr_array(
            (moved.data, (moved.row, self.surface[moved.col])), shape=(len(self.loaded), size)
        )

    @cached_property
    def moved(self) -> np.ndarray:
        """(d, s) complex: displacements of the surface by these coordinates."""
        return np.asarray(self.trace[:, self.loaded].toarray())

    @cached_property
    def answers(self) -> LoadedProblem:
        """To unit loads on these coordinates."""
        return LoadedProblem(self.problem, self.unit, self.loaded)

    @cached_property
    def inertial(self) -> np.ndarray:
        """(m, s) of M times the static responses."""
        return np.asarray(self.M @ self.answers.responses)


def surface_dofs(mesh: HalfPitchMesh) -> np.ndarray:
    """Displacements of the half pitch's nodes on the outer surface."""
    radius = surface_radius(mesh)
    nodes = np.flatnonzero(np.abs(np.hypot(*mesh.nodes[:, :2].T) - radius) < TOLERANCE * radius)
    return np.asarray((3 * nodes[:, None] + np.arange(3)).ravel())
