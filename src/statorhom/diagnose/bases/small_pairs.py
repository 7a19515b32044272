"""Generalized eigenpairs of matrices so small that a checking wrapper would cost more than the solution."""

from __future__ import annotations

import numpy as np
from scipy.linalg.lapack import dsygvd

from statorhom.errors import SolverError


def small_pairs(K: np.ndarray, M: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """All eigenpairs of K x = λ M x, mass-normalised.

    Parameters
    ----------
    K, M : symmetric (k, k); M definite.

    Returns
    -------
    values : (k,) ascending.
    vectors : (k, k).

    Raises
    ------
    SolverError
        If M is not definite.
    """
    if len(K) == 0:
        return np.empty(0), np.empty((0, 0))
    values, vectors, info = dsygvd(K, M)
    if info != 0:
        raise SolverError("the mass of a region must be positive")
    return values, vectors
