"""Z = K - λM of many harmonics, condensed on the slot's plane: two sparse factorizations for all of them.

Eliminating the coordinates a and b leaves S_h = D₁ S_a D₁ + D₂ S_b D₂ on the slot's plane, with the small dense
S_x = Z_ss - Z_sx Z_xx⁻¹ Z_xs that no harmonic changes. The numbers of negative eigenvalues add up (Haynsworth 1968):
those of Z_aa, Z_bb and S_h together are the number of modes below λ, a proof that none is missing (Sylvester's law).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from scipy.linalg import lapack
from scipy.sparse.linalg import SuperLU

from statorhom.errors import SolverError
from statorhom.model.cyclic.half_pitch import HalfPitch, Phases
from statorhom.model.eigen import symmetric_lu

# of a solve without pivoting, against the matrix times the solution: a factorization that is to be trusted
BACKWARD_ERROR = 1e-10


@dataclass(frozen=True, eq=False)
class Counted:
    """One of the two families of coordinates, eliminated for the number of modes alone.

    Parameters
    ----------
    schur : (s, s) S_x.
    negative : number of negative eigenvalues of Z_xx, None if the factorization cannot tell.
    """

    schur: np.ndarray
    negative: int | None


@dataclass(frozen=True, eq=False)
class Eliminated:
    """One of the two families of coordinates, eliminated.

    Parameters
    ----------
    lu : factors of Z_xx.
    coupling : (s, x) Z_sx.
    responses : (x, s) Z_xx⁻¹ Z_xs.
    schur : (s, s) S_x.
    """

    lu: SuperLU
    coupling: sp.csr_array
    responses: np.ndarray
    schur: np.ndarray

    @property
    def order(self) -> np.ndarray:
        """The family's coordinates in the order of their elimination, (x,): what leaves few entries at any λ."""
        return np.argsort(self.lu.perm_c)

    def sampled(self, weights: np.ndarray) -> np.ndarray:
        """Vectors (x, k) with covariance Z_xx⁻¹, which must be definite, from independent weights of unit variance."""
        # P Z Pᵀ = L D Lᵀ
        loads = self.lu.L @ (np.sqrt(self.lu.U.diagonal())[:, None] * weights)
        return np.asarray(self.lu.solve(np.ascontiguousarray(loads[self.lu.perm_r])))


def eliminated(pitch: HalfPitch, family: np.ndarray, value: float) -> Eliminated:
    """Eliminate the coordinates `family` (`pitch.a` or `pitch.b`) of K - value M."""
    Z = sp.csr_array(pitch.K - value * pitch.M)
    rows, slot = Z[family], Z[pitch.s]
    inner, coupling = sp.csr_array(rows[:, family]), sp.csr_array(slot[:, family])
    lu = symmetric_lu(inner)
    responses = lu.solve(coupling.T.toarray())
    schur = slot[:, pitch.s].toarray() - coupling @ responses
    return Eliminated(lu, coupling, responses, 0.5 * (schur + schur.T))


def counted(pitch: HalfPitch, family: np.ndarray, order: np.ndarray, value: float) -> Counted:
    """Eliminate the coordinates `family` of K - value M; one factorization with the slot's plane last tells all.

    Parameters
    ----------
    order : (x,) in which the family is eliminated (`Eliminated.order`).
    """
    count, used = len(family), np.r_[family[order], pitch.s]
    Z = sp.csr_array(pitch.K - value * pitch.M)[used][:, used]
    lu = symmetric_lu(Z, ordered=True)
    # what is left of the last coordinates when the first are gone
    schur = (lu.L[count:, count:] @ lu.U[count:, count:]).toarray()
    negative = int(np.count_nonzero(lu.U.diagonal()[:count] < 0)) if _trusted(Z, lu) else None
    return Counted(0.5 * (schur + schur.T), negative)


def _trusted(matrix: sp.csr_array, lu: SuperLU) -> bool:
    """Whether the signs of the pivots are those of the eigenvalues."""
    if not np.array_equal(lu.perm_r, lu.perm_c):
        return False
    right = np.random.default_rng(0).standard_normal(matrix.shape[0])
    x = lu.solve(right)
    size = abs(matrix).sum(axis=0).max() * np.linalg.norm(x)
    return bool(np.linalg.norm(matrix @ x - right) <= BACKWARD_ERROR * size)


@dataclass(frozen=True, eq=False)
class Condensed:
    """K - λM of some problems below their lowest eigenvalues: it solves and samples.

    Parameters
    ----------
    pitch : the matrices.
    phases : the p problems.
    real, imaginary : the eliminated coordinates a and b.
    root : (p, s, s) inverse of the Cholesky factor of every S_h.
    """

    pitch: HalfPitch
    phases: Phases
    real: Eliminated
    imaginary: Eliminated
    root: np.ndarray

    def take(self, chosen: np.ndarray) -> Condensed:
        """Some of the problems."""
        return Condensed(self.pitch, self.phases.take(chosen), self.real, self.imaginary, self.root[chosen])

    def solve(self, right: np.ndarray) -> np.ndarray:
        """(K - λM)⁻¹ times one vector of every problem, (n, p)."""
        a, b, s = np.split(right, np.cumsum(self.pitch.sizes)[:-1])
        a, b = self.real.lu.solve(a), self.imaginary.lu.solve(b)
        D1, D2 = self.phases.first, self.phases.second
        rest = s - D1 * (self.real.coupling @ a) - D2 * (self.imaginary.coupling @ b)
        slot = np.swapaxes(self.root, 1, 2) @ (self.root @ rest.T[:, :, None])
        slot = slot[:, :, 0].T
        a = a - self.real.responses @ (D1 * slot)
        b = b - self.imaginary.responses @ (D2 * slot)
        return np.concatenate([a, b, slot])

    def mass(self, vectors: np.ndarray) -> np.ndarray:
        """M times one vector of every problem, (n, p)."""
        return multiplied(self.pitch, self.phases, self.pitch.M, vectors)


def condensed(pitch: HalfPitch, phases: Phases, real: Eliminated, imaginary: Eliminated) -> Condensed:
    """Put the problems together.

    Raises
    ------
    SolverError
        If K - λM is not positive definite.
    """
    try:
        root = np.linalg.inv(np.linalg.cholesky(_schur(phases, real, imaginary)))
    except np.linalg.LinAlgError:
        raise SolverError("the stiffness matrix is not positive semidefinite; check the materials") from None
    return Condensed(pitch, phases, real, imaginary, root)


def modes_under(phases: Phases, real: Counted, imaginary: Counted) -> np.ndarray:
    """Number of modes of every problem below λ, (p,); the factorizations must be able to tell."""
    assert real.negative is not None and imaginary.negative is not None
    parity = [space.parity for space in phases.spaces]
    counts = [_negative_dense(S) for S in _schur(phases, real, imaginary)]
    for i, kind in enumerate(parity):
        counts[i] += (kind != "odd") * real.negative + (kind != "even") * imaginary.negative
    return np.array(counts)


def multiplied(pitch: HalfPitch, phases: Phases, matrix: sp.csr_array, vectors: np.ndarray) -> np.ndarray:
    """K or M of the half pitch times one vector of every problem, (n, p)."""
    a, b, s = np.split(vectors, np.cumsum(pitch.sizes)[:-1])
    count = vectors.shape[1]
    motion = np.zeros((matrix.shape[0], 2 * count))
    motion[pitch.a, :count], motion[pitch.b, count:] = a, b
    motion[pitch.s, :count], motion[pitch.s, count:] = phases.first * s, phases.second * s
    force = matrix @ motion
    real, imaginary = force[:, :count], force[:, count:]
    slot = phases.first * real[pitch.s] + phases.second * imaginary[pitch.s]
    return np.concatenate([real[pitch.a], imaginary[pitch.b], slot])


def _schur(phases: Phases, real: Counted | Eliminated, imaginary: Counted | Eliminated) -> np.ndarray:
    """S_h of every problem, (p, s, s); coordinates that it has not are fixed by a stiffness of their own."""
    D1, D2 = phases.first.T, phases.second.T
    S = D1[:, :, None] * real.schur * D1[:, None] + D2[:, :, None] * imaginary.schur * D2[:, None]
    problem, absent = np.nonzero((D1 == 0) & (D2 == 0))
    S[problem, absent, absent] = np.abs(real.schur).max()
    return np.asarray(S)


def _negative_dense(matrix: np.ndarray) -> int:
    """Number of negative eigenvalues by the Bunch-Kaufman factorization; a 2 × 2 pivot has one of each sign."""
    factors, pivots, info = lapack.dsytrf(matrix, lower=1)
    if info < 0:
        raise SolverError("the stiffness matrix has entries that are not numbers; check the materials")
    single = pivots > 0
    return int(np.count_nonzero(np.diagonal(factors)[single] < 0) + np.count_nonzero(~single) // 2)
