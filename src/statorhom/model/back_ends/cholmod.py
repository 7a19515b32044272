"""CHOLMOD's supernodal Cholesky factorization, from the wheel of kvxopt."""

from __future__ import annotations

from types import ModuleType

import numpy as np
import scipy.sparse as sp

from statorhom.errors import MissingDependencyError
from statorhom.model.back_ends.checked import checked, not_definite
from statorhom.model.eigen import Solve


def library() -> ModuleType:
    """kvxopt.

    Raises
    ------
    MissingDependencyError
    """
    try:
        import kvxopt.cholmod
    except ImportError:
        raise MissingDependencyError(
            "cholmod: kvxopt is not installed; run: pip install 'statorhom[general]'"
        ) from None
    return kvxopt


def cholmod(matrix: sp.csr_array) -> Solve:
    """Factorize a symmetric positive definite matrix.

    Raises
    ------
    MissingDependencyError
    SolverError
        If it is not one, or if the check of the residual fails.
    """
    kvxopt = library()
    lower = sp.tril(matrix, format="coo")
    sparse = kvxopt.spmatrix(kvxopt.matrix(lower.data), lower.row, lower.col, lower.shape)
    factor = kvxopt.cholmod.symbolic(sparse)

    def solve(right: np.ndarray) -> np.ndarray:
        x = kvxopt.matrix(np.asarray(right, dtype=float))
        kvxopt.cholmod.solve(factor, x)
        return np.array(x).reshape(right.shape)

    try:
        kvxopt.cholmod.numeric(sparse, factor)
        # a factorization that stopped half-way is told by the first solve
        return checked("cholmod", matrix, solve)
    except ArithmeticError:
        raise not_definite("cholmod") from None
