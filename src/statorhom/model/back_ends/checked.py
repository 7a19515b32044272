"""What every back end is held to: the backward error of one solve with a random right-hand side."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp

from statorhom.errors import SolverError
from statorhom.model.eigen import Solve

# a healthy Cholesky factorization leaves 1e-15, of thin skins' badly conditioned matrices too
LARGEST_RESIDUAL = 1e-10


def checked(name: str, matrix: sp.csr_array, solve: Solve) -> Solve:
    """Return `solve`, a back end's own, if it solves.

    Raises
    ------
    SolverError
        If ‖A x − b‖ > 1e-10 ‖ |A| |x| + |b| ‖ for a random b, the backward error of Oettli and Prager (Numer. Math. 6,
        1964) in norms, or if xᵀb < 0, which no definite matrix gives.
    """
    right = np.random.default_rng(0).standard_normal(matrix.shape[0])
    x = solve(right)
    scale = np.linalg.norm(abs(matrix) @ np.abs(x) + np.abs(right))
    residual = np.linalg.norm(matrix @ x - right) / scale
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
