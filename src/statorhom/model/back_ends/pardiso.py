"""MKL's PARDISO through pypardiso's lower level.

pypardiso's own `spsolve` assumes unsymmetric matrices and hands the whole matrix over for each solve.
"""

from __future__ import annotations

import weakref
from copy import copy
from types import ModuleType
from typing import Any

import numpy as np
import scipy.sparse as sp

from statorhom.errors import MissingDependencyError, SolverError
from statorhom.model.back_ends.checked import checked, not_definite
from statorhom.model.eigen import Solve

POSITIVE_DEFINITE = 2  # matrix type: real, symmetric
# parameters by PARDISO's numbers: ours instead of its defaults (1), which are METIS (2), but without (8) the two
# steps of refinement that would quadruple the time of a solve
PARAMETERS = {1: 1, 2: 2, 8: 0}
FACTORIZE, SOLVE, RELEASE = 12, 33, -1  # phases
NOT_DEFINITE = -4  # error code


def library() -> ModuleType:
    """pypardiso.

    Raises
    ------
    MissingDependencyError
    """
    try:
        import pypardiso
    except (ImportError, OSError):  # it loads MKL when it is imported
        raise MissingDependencyError(
            "pardiso: pypardiso or MKL is not installed; run: pip install 'statorhom[general]'"
        ) from None
    return pypardiso


def pardiso(matrix: sp.csr_array) -> Solve:
    """Factorize a symmetric positive definite matrix.

    Raises
    ------
    MissingDependencyError
    SolverError
        If it is not one, or if the check of the residual fails.
    """
    pypardiso = library()
    n = matrix.shape[0]
    solver = _solver(pypardiso)
    upper = sp.csr_matrix(sp.triu(matrix, format="csr"))
    upper.sort_indices()
    # phases after the factorization need the matrix's size alone
    blank = sp.csr_matrix((n, n))
    try:
        _call(solver, FACTORIZE, upper, np.zeros(n))
    except pypardiso.pardiso_wrapper.PyPardisoError as error:
        _call(solver, RELEASE, blank, np.zeros(n))
        if error.value == NOT_DEFINITE:
            raise not_definite("pardiso") from None
        raise SolverError(
            f"pardiso: the factorization failed with code {error.value}; choose another back end"
        ) from None

    def solve(right: np.ndarray) -> np.ndarray:
        return _call(solver, SOLVE, blank, np.asfortranarray(right, dtype=float))

    # MKL keeps the factors until it is told
    weakref.finalize(solve, _call, solver, RELEASE, blank, np.zeros(n))
    return checked("pardiso", matrix, solve)


def _solver(pypardiso: ModuleType) -> Any:
    """A solver of its own memory; a new one would search the disk for MKL, which takes a second."""
    solver = copy(pypardiso.ps)
    solver.pt, solver.iparm = np.zeros_like(solver.pt), np.zeros_like(solver.iparm)
    solver.set_matrix_type(POSITIVE_DEFINITE)
    for number, value in PARAMETERS.items():
        solver.set_iparm(number, value)
    return solver


def _call(solver: Any, phase: int, matrix: sp.csr_matrix, right: np.ndarray) -> np.ndarray:
    solver.set_phase(phase)
    return np.asarray(solver._call_pardiso(matrix, right))
