"""What every back end is held to: the residual of one solve with a random right-hand side."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp

from statorhom.errors import SolverError
from statorhom.model.eigen import Solve

# a healthy Cholesky factorization of a stator's matrix leaves 1e-12
LARGEST_RESIDUAL = 1e-8


def checked(name: str, matrix: sp.csr_array, solve: Solve) -> Solve:
    """Return `solve`, a back end's own, if it solves.

    Raises
    ------
    SolverError
        If ‖A x − b‖ > 1e-8 ‖b‖ for a random b, or if xᵀb < 0, which no definite matrix gives.
    """
    right = np.random.default_rng(0).standard_normal(matrix.shape[0])
    x = solve(right)
    residual = np.linalg.norm(matrix @ x - right) / np.linalg.norm(right)
    if not residual <= LARGEST_RESIDUAL:
        raise SolverError(
            f"{name}: a solve left a relative residual of {residual:.1e} after the factorization; "
            "check materials, springs and masses, or choose another back end"
        )
    if x @ right < 0:
        raise not_definite(name)
    return solve


def not_definite(name: str) -> SolverError:
    """The error of a back end that met a matrix which is not positive definite."""
    return SolverError(
        f"{name}: the matrix is not positive definite; check materials, springs and masses for negative ones"
    )
