"""Lowest eigenpairs of a sparse symmetric pair, every one below a given frequency."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import scipy.sparse as sp
from scipy.linalg import eigh
from scipy.sparse.linalg import LinearOperator, SuperLU, eigsh, splu

from statorhom.errors import SolverError
from statorhom.model.blas_threads import one_blas_thread

# shift below zero, as a part of the band's highest eigenvalue: rigid bodies keep the matrix definite
SHIFT = 0.05

Solve = Callable[[np.ndarray], np.ndarray]
# of a sparse symmetric positive definite matrix
Factorize = Callable[[sp.csr_array], Solve]


def factorize(matrix: sp.csr_array) -> Solve:
    """What solves with a symmetric positive definite matrix; see `symmetric_lu`."""
    solve: Solve = symmetric_lu(matrix).solve
    return solve


def symmetric_lu(matrix: sp.csr_array, ordered: bool = False) -> SuperLU:
    """Sparse LU of a symmetric positive definite matrix (SuperLU without pivoting, minimum degree of A + Aᵀ).

    Parameters
    ----------
    ordered : whether rows and columns are eliminated as they stand.

    Raises
    ------
    SolverError
        If the matrix is singular or has entries that are not numbers.
    """
    try:
        # by columns a symmetric matrix reads as it does by rows
        return splu(
            sp.csc_matrix((matrix.data, matrix.indices, matrix.indptr), shape=matrix.shape, copy=True),
            permc_spec="NATURAL" if ordered else "MMD_AT_PLUS_A",
            diag_pivot_thresh=0.0,
            options={"SymmetricMode": True},
        )
    except RuntimeError as error:
        raise SolverError(
            f"the stiffness matrix cannot be factorized ({error}); check the materials"
        ) from None


def modes_below(
    K: sp.csr_array,
    M: sp.csr_array,
    highest_hz: float,
    expected: int = 8,
    most: int | None = None,
    back_end: Factorize = factorize,
    tolerance: float = 0.0,
    beyond: int = 0,
) -> tuple[np.ndarray, np.ndarray]:
    """All eigenpairs of K x = λ M x up to a frequency, rigid-body modes included.

    Parameters
    ----------
    K, M : symmetric (n, n); K semidefinite, M definite.
    highest_hz : upper end of the band.
    expected : how many modes to ask for first; doubled until the band is covered.
    most : stop at this many modes although the band may hold more; None for all.
    back_end : factorizes the shifted matrix.
    tolerance : relative, of the eigenvalues above the shift; 0 for rounding alone.
    beyond : how many of the next modes above the band to return too.

    Returns
    -------
    eigenvalues : (k,) λ in rad²/s², ascending.
    vectors : (n, k), mass-normalised.

    Raises
    ------
    SolverError
        If the iteration does not converge.
    """
    top = (2 * np.pi * highest_hz) ** 2
    sigma = -SHIFT * top
    with one_blas_thread():
        solve = back_end(sp.csr_array(K - sigma * M))
        count = expected if most is None else min(expected, most)
        while True:
            values, vectors = _lowest(K, M, sigma, solve, count, tolerance)
            inside = int((values <= top).sum())
            if len(values) > inside + max(beyond - 1, 0) or len(values) == K.shape[0] or count == most:
                return values[: inside + beyond], vectors[:, : inside + beyond]
            count = 2 * count if most is None else min(2 * count, most)


def lowest_modes(
    K: sp.csr_array, M: sp.csr_array, count: int, scale_hz: float, back_end: Factorize = factorize
) -> tuple[np.ndarray, np.ndarray]:
    """The `count` lowest eigenpairs; `scale_hz` is a typical frequency of theirs."""
    sigma = -SHIFT * (2 * np.pi * scale_hz) ** 2
    with one_blas_thread():
        return _lowest(K, M, sigma, back_end(sp.csr_array(K - sigma * M)), count)


def _lowest(
    K: sp.csr_array, M: sp.csr_array, sigma: float, solve: Solve, count: int, tolerance: float = 0.0
) -> tuple[np.ndarray, np.ndarray]:
    n = K.shape[0]
    if count >= n - 1:
        return _dense(K, M)
    operator = LinearOperator((n, n), matvec=solve, dtype=float)
    start = np.random.default_rng(0).standard_normal(n)  # a fixed start: the same study gives the same digits
    try:
        values, vectors = eigsh(
            K, count, M, sigma=sigma, OPinv=operator, v0=start, ncv=min(n, 2 * count + 10), tol=tolerance
        )
    except Exception as error:
        raise SolverError(
            f"the eigenvalue iteration failed ({error}); refine the mesh or check the materials"
        ) from None
    order = np.argsort(values)
    return values[order], vectors[:, order]


def _dense(K: sp.csr_array, M: sp.csr_array) -> tuple[np.ndarray, np.ndarray]:
    values, vectors = eigh(K.toarray(), M.toarray())
    return values, vectors


def frequency_hz(eigenvalues: np.ndarray) -> np.ndarray:
    """Natural frequencies of eigenvalues λ = ω²; rounding below zero counts as zero."""
    return np.sqrt(np.maximum(eigenvalues, 0.0)) / (2 * np.pi)
