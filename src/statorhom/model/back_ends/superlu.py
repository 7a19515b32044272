"""SciPy's SuperLU: always there, several times slower than a Cholesky factorization."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp

from statorhom.model.back_ends.checked import checked, not_definite
from statorhom.model.eigen import Solve, factorize

STEPS = 12  # a tenth of the factorization's time
ROUNDING = 1e-12


def superlu(matrix: sp.csr_array) -> Solve:
    """Factorize a symmetric positive definite matrix.

    An LU factorization exists for indefinite matrices as well, and SciPy shows U's diagonal only in a copy that
    doubles the memory. So a few steps of Lanczos' iteration with A and with A⁻¹ look for negative eigenvalues: they
    find those that are large or small against the others, which negative springs and materials cause.

    Raises
    ------
    SolverError
        If a negative eigenvalue is found, or if the check of the residual fails.
    """
    solve = checked("superlu", matrix, factorize(matrix))
    for apply in (matrix.__matmul__, solve):
        values = _ritz_values(apply, matrix.shape[0])
        if values[0] < -ROUNDING * values[-1]:
            raise not_definite("superlu")
    return solve


def _ritz_values(apply: Solve, n: int) -> np.ndarray:
    """Eigenvalues of a symmetric operator in a Krylov space, ascending: within those of the operator."""
    vector = np.random.default_rng(1).standard_normal(n)
    basis, image = np.empty((0, n)), np.empty((0, n))
    for _ in range(STEPS):
        before = np.linalg.norm(vector)
        for _ in range(2):  # once leaves rounding
            vector = vector - basis.T @ (basis @ vector)
        length = np.linalg.norm(vector)
        if length <= ROUNDING * before:  # the space is invariant
            break
        basis = np.vstack([basis, vector / length])
        vector = apply(basis[-1])
        image = np.vstack([image, vector])
    return np.linalg.eigvalsh(basis @ image.T)
