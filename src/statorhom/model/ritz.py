"""Dense eigenproblems of reduced models: many small ones at a time, or the lowest pairs of one."""

from __future__ import annotations

import numpy as np
from scipy.linalg import eigh, solve_triangular

UNIT_MASS = (
    1e-8  # how far M may lie from the identity and still count as it, the rounding of orthonormal bases
)


def ritz_pairs(K: np.ndarray, M: np.ndarray | None) -> tuple[np.ndarray, np.ndarray]:
    """All pairs of K x = λ M x.

    Parameters
    ----------
    K : (…, k, k) symmetric.
    M : (…, k, k) definite, or None for the identity.

    Returns
    -------
    values : (…, k) ascending.
    vectors : (…, k, k), columns of unit mass.
    """
    if M is None:
        values, vectors = np.linalg.eigh(K)
        return values, vectors
    root = np.linalg.inv(np.linalg.cholesky(M))
    turned = np.swapaxes(root, -1, -2)
    values, vectors = np.linalg.eigh(root @ K @ turned)
    return values, turned @ vectors


def lowest_pairs(K: np.ndarray, M: np.ndarray, top: float) -> tuple[np.ndarray, np.ndarray]:
    """Eigenvalues up to `top` of K x = λ M x with dense K and M, and their M-normalised vectors."""
    if np.abs(M - np.eye(len(M))).max() < UNIT_MASS:
        return standard_pairs(K, top)
    L = np.linalg.cholesky(M)
    half = solve_triangular(L, K, lower=True, check_finite=False)
    values, vectors = standard_pairs(solve_triangular(L, half.T, lower=True, check_finite=False), top)
    return values, solve_triangular(L, vectors, lower=True, trans="T", check_finite=False)


def standard_pairs(matrix: np.ndarray, top: float) -> tuple[np.ndarray, np.ndarray]:
    """Eigenvalues up to `top` of a symmetric matrix, and their orthonormal vectors."""
    # asking for a part of the spectrum costs LAPACK four times as much as all of it by divide and conquer
    values, vectors = eigh(matrix, check_finite=False, driver="evd")
    count = int(np.searchsorted(values, top, side="right"))
    return values[:count], vectors[:, :count]
