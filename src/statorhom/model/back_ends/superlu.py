"""SciPy's SuperLU: always there, several times slower than a Cholesky factorization."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp

from statorhom.model.back_ends.checked import checked, not_definite
from statorhom.model.eigen import Solve, symmetric_lu


def superlu(matrix: sp.csr_array) -> Solve:
    """Factorize a symmetric positive definite matrix.

    Raises
    ------
    SolverError
        If it is not one, or if the check of the residual fails.
    """
    lu = symmetric_lu(matrix)
    # without pivoting A = L D Lᵀ, U = D Lᵀ, and D has as many negative entries as A has negative eigenvalues
    if not np.array_equal(lu.perm_r, lu.perm_c) or lu.U.diagonal().min() <= 0:
        raise not_definite("superlu")
    return checked("superlu", matrix, lu.solve)
