"""Lowest eigenpairs of the coupled problem: by Lanczos where it is large, checked by its inertia."""

from __future__ import annotations

import numpy as np
from scipy.linalg import cho_factor, cho_solve, ldl
from scipy.sparse.linalg import LinearOperator, eigsh

from statorhom.model.ritz import UNIT_MASS, lowest_pairs

LARGE = 500  # coordinates from which on the band is too small a part for a full reduction


def lowest_coupled(
    K: np.ndarray, M: np.ndarray, top: float, shift: float, expected: int
) -> tuple[np.ndarray, np.ndarray]:
    """All eigenpairs of K x = λ M x up to `top`, mass-normalised.

    Parameters
    ----------
    K, M : symmetric (n, n), K + σ M definite.
    top : highest eigenvalue (rad²/s²).
    shift : σ.
    expected : about how many there are.

    Raises
    ------
    numpy.linalg.LinAlgError
        If M or K + σ M is not definite.
    """
    if len(K) < max(LARGE, 4 * expected):
        return lowest_pairs(K, M, top)
    factor = cho_factor(K + shift * M, check_finite=False)
    operator = LinearOperator(K.shape, matvec=lambda b: cho_solve(factor, b, check_finite=False), dtype=float)
    start = np.random.default_rng(0).standard_normal(len(K))  # a fixed start: the same digits every time
    mass = None if np.abs(M - np.eye(len(M))).max() < UNIT_MASS else M
    values, x = eigsh(K, expected, mass, sigma=-shift, OPinv=operator, v0=start, ncv=2 * expected + 10)
    keep = np.argsort(values)[: np.count_nonzero(values <= top)]
    # what lies between two modes, or a doublet's second one, Lanczos may pass over
    _, inertia, _ = ldl(K - top * M, check_finite=False)
    if len(keep) != _negative(inertia):
        return lowest_pairs(K, M, top)
    return values[keep], x[:, keep]


def _negative(inertia: np.ndarray) -> int:
    """Negative eigenvalues of a matrix of blocks of one and two."""
    diagonal, beside = np.diag(inertia), np.append(np.diag(inertia, -1), 0.0)
    # the two eigenvalues of a block of two differ in sign
    paired = (beside != 0) | np.roll(beside != 0, 1)
    return int(np.count_nonzero(diagonal[~paired] < 0) + np.count_nonzero(beside))
