"""One harmonic's problem in its own coordinates y, with the factors that it shares with all others of its part."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.sparse as sp

from statorhom.model.cyclic.condensed import Condensed, Eliminated, condensed, eliminated, multiplied
from statorhom.model.cyclic.half_pitch import HalfPitch, Phases, columns, phases
from statorhom.model.harmonic import Harmonic


@dataclass(frozen=True, eq=False)
class Shifted:
    """K + σM of a part, factorized when it is first asked for.

    Parameters
    ----------
    pitch : the matrices.
    shift : σ (rad²/s²).
    """

    pitch: HalfPitch
    shift: float

    @cached_property
    def families(self) -> tuple[Eliminated, Eliminated]:
        """The coordinates a and b, eliminated."""
        real, imaginary = (eliminated(self.pitch, f, -self.shift) for f in (self.pitch.a, self.pitch.b))
        return real, imaginary

    def __getstate__(self) -> dict[str, object]:
        """What other processes need: factors cannot be sent."""
        return {"pitch": self.pitch, "shift": self.shift}


@dataclass(frozen=True, eq=False)
class ProblemMatrix:
    """K or M of a problem: it is multiplied without ever being put together."""

    pitch: HalfPitch
    phases: Phases
    matrix: sp.csr_array
    columns: np.ndarray
    factor: float

    def __matmul__(self, y: np.ndarray) -> np.ndarray:
        """Times (m, k)."""
        vectors = np.zeros((sum(self.pitch.sizes), y.shape[1]))
        vectors[self.columns] = y
        return np.asarray(
            self.factor * multiplied(self.pitch, self.phases, self.matrix, vectors)[self.columns]
        )


@dataclass(frozen=True, eq=False)
class CyclicProblem:
    """The problem of one harmonic, times its copies, so that yᵀ M y is the whole stator's.

    Parameters
    ----------
    space : the harmonic.
    shifted : of its part.
    """

    space: Harmonic
    shifted: Shifted

    @cached_property
    def K(self) -> ProblemMatrix:
        """(m, m) stiffness."""
        return self._matrix(self.shifted.pitch.K)

    @cached_property
    def M(self) -> ProblemMatrix:
        """(m, m) mass."""
        return self._matrix(self.shifted.pitch.M)

    def solve(self, right: np.ndarray) -> np.ndarray:
        """(K + σM)⁻¹ times (m, k)."""
        factors, (D1, D2) = self.factors, self.turns
        a, b, s = self.split(right)
        a, b = factors.real.lu.solve(a), factors.imaginary.lu.solve(b)
        rest = s - D1 * (factors.real.coupling @ a) - D2 * (factors.imaginary.coupling @ b)
        slot = factors.root[0].T @ (factors.root[0] @ rest)
        return self._joined(a, b, slot) / self.space.copies

    def sampled(self, weights: np.ndarray) -> np.ndarray:
        """Vectors (m, k) with covariance (K + σM)⁻¹ from weights (m, k) that are independent and of unit variance."""
        factors = self.factors
        a, b, s = self.split(weights)
        a, b = factors.real.sampled(a), factors.imaginary.sampled(b)
        return self._joined(a, b, factors.root[0].T @ s) / np.sqrt(self.space.copies)

    def __getstate__(self) -> dict[str, object]:
        """What other processes need: factors cannot be sent."""
        return {"space": self.space, "shifted": self.shifted}

    @cached_property
    def columns(self) -> np.ndarray:
        """(m,) of the coordinates y among a, b and the slot's plane."""
        return columns(self.shifted.pitch, self.space)

    @property
    def turns(self) -> tuple[np.ndarray, np.ndarray]:
        """D₁ and D₂, (slot's plane, 1)."""
        return self._phases.first, self._phases.second

    @cached_property
    def factors(self) -> Condensed:
        """K + σM, eliminated down to the slot's plane; of one copy."""
        return condensed(self.shifted.pitch, self._phases, *self.shifted.families)

    def split(self, y: np.ndarray) -> list[np.ndarray]:
        """Vectors (m, k) as their parts of a, b and the slot's plane."""
        sizes = self.shifted.pitch.sizes
        vectors = np.zeros((sum(sizes), y.shape[1]))
        vectors[self.columns] = y
        return np.split(vectors, np.cumsum(sizes)[:-1])

    def chosen(self, parts: Sequence[np.ndarray]) -> np.ndarray:
        """Vectors (m, k) of their parts of a, b and the slot's plane."""
        return np.asarray(np.concatenate(parts)[self.columns])

    @cached_property
    def _phases(self) -> Phases:
        return phases(self.shifted.pitch, (self.space,))

    def _matrix(self, matrix: sp.csr_array) -> ProblemMatrix:
        factor = float(self.space.copies)
        return ProblemMatrix(self.shifted.pitch, self._phases, matrix, self.columns, factor)

    def _joined(self, a: np.ndarray, b: np.ndarray, slot: np.ndarray) -> np.ndarray:
        """What the slot's plane moves too, in the coordinates y."""
        factors, (D1, D2) = self.factors, self.turns
        a = a - factors.real.responses @ (D1 * slot)
        b = b - factors.imaginary.responses @ (D2 * slot)
        return self.chosen([a, b, slot])
