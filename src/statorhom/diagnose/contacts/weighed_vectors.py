"""Vectors of one harmonic together with what its matrices make of them.

Rounds of a search for modes take sums of the same vectors again and again. What matrices make of a sum is the sum of
what they made of its parts, so that only what is new is multiplied by them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from scipy.linalg import eigh, solve_triangular
from scipy.sparse.linalg import SuperLU, splu

from statorhom.model.harmonic import Harmonic

FloatArray = np.ndarray
Factors = tuple[SuperLU, SuperLU]

LEAST = 1e-8  # part of a solution's strain energy that a vector must carry


@dataclass(frozen=True, eq=False)
class WeighedVectors:
    """Columns (m, t).

    Parameters
    ----------
    own : the vectors V.
    heavy : W V, of the matrix in whose energy they are weighed.
    mass : M V.
    """

    own: FloatArray
    heavy: FloatArray
    mass: FloatArray

    def __len__(self) -> int:
        return int(self.own.shape[1])

    def __matmul__(self, coordinates: FloatArray) -> WeighedVectors:
        return WeighedVectors(self.own @ coordinates, self.heavy @ coordinates, self.mass @ coordinates)

    def without(self, basis: WeighedVectors) -> WeighedVectors:
        """What is left of these beside a basis of unit energies."""
        left = self
        for _ in range(2):  # once more for what rounding left
            parts = basis @ (basis.heavy.T @ left.own)
            left = WeighedVectors(left.own - parts.own, left.heavy - parts.heavy, left.mass - parts.mass)
        return left

    @property
    def energies(self) -> FloatArray:
        """Vᵀ W V."""
        return np.asarray(self.own.T @ self.heavy)


def together(parts: Sequence[WeighedVectors]) -> WeighedVectors:
    """One after the other."""
    return WeighedVectors(
        *(np.hstack([getattr(p, name) for p in parts]) for name in ("own", "heavy", "mass"))
    )


@dataclass(frozen=True, eq=False)
class WeighedProblem:
    """One harmonic of a mesh whose parts meet over a contact.

    Parameters
    ----------
    space : its coordinates.
    weak, mass : W = K + σM with the contact hardly there, and M.
    contact : what the intact contact adds to W.
    shift : σ.
    """

    space: Harmonic
    weak: sp.csr_array
    mass: sp.csr_array
    contact: sp.csr_array
    shift: float

    @classmethod
    def of(
        cls, space: Harmonic, weak: sp.csr_array, mass: sp.csr_array, contact: sp.csr_array, shift: float
    ) -> WeighedProblem:
        """Of matrices of the half pitch; `weak` is without the mass."""
        weak, mass, contact = (sp.csr_array(space.copies * space.project(m)) for m in (weak, mass, contact))
        return cls(space, sp.csr_array(weak + shift * mass), mass, contact, shift)

    def factored(self) -> Factors:
        """Factors of K + σM with the contact intact, and hardly there; they are large."""
        return splu(sp.csc_matrix(self.weak + self.contact)), splu(sp.csc_matrix(self.weak))

    def weighed(self, vectors: FloatArray) -> WeighedVectors:
        """Vectors (m, t) with their products."""
        return WeighedVectors(vectors, self.weak @ vectors, self.mass @ vectors)

    def of_unit_energies(self, vectors: FloatArray) -> WeighedVectors:
        """A basis of what independent vectors (m, t) span."""
        found = self.weighed(vectors)
        if not len(found):
            return found
        energies = found.energies
        factor = np.linalg.cholesky((energies + energies.T) / 2)
        return found @ solve_triangular(factor, np.eye(len(factor)), lower=True).T

    def stiffness(self, vectors: WeighedVectors) -> FloatArray:
        """K V, the contact intact."""
        return np.asarray(vectors.heavy - self.shift * vectors.mass + self.contact @ vectors.own)

    def ritz(self, basis: WeighedVectors) -> tuple[FloatArray, WeighedVectors]:
        """λ and vectors (m, k) of unit mass in a basis."""
        K, M = basis.own.T @ self.stiffness(basis), basis.own.T @ basis.mass
        values, x = eigh((K + K.T) / 2, (M + M.T) / 2)
        return values, basis @ x

    def answers(self, factors: Factors, forces: FloatArray) -> WeighedVectors:
        """To forces (m, t), with the contact intact and hardly there."""
        bonded, loose = (np.asarray(f.solve(forces)) for f in factors)
        own, heavy = np.hstack([bonded, loose]), np.hstack([forces - self.contact @ bonded, forces])
        return WeighedVectors(own, heavy, self.mass @ own)

    def joined(self, basis: WeighedVectors, more: WeighedVectors, most: int) -> WeighedVectors:
        """A basis of unit energies with the directions of further vectors that carry most energy of what it lacks."""
        more = more.without(basis)
        values, turn = np.linalg.eigh(more.energies)
        chosen = [i for i in np.argsort(-values)[:most] if values[i] > LEAST]
        return together([basis, more @ (turn[:, chosen] / np.sqrt(values[chosen]))])
