"""The fastest back end that solves: thin plates are near the end of what double precision holds."""

from __future__ import annotations

import scipy.sparse as sp

from statorhom.errors import SolverError
from statorhom.model.back_ends.choice import best_available
from statorhom.model.eigen import Solve, factorize


def sturdy(matrix: sp.csr_array) -> Solve:
    """What solves with a symmetric positive definite matrix.

    A plate of a thousandth of its length in thickness bends a million times more easily than it stretches; a back end
    that loses too many digits with it refuses itself, and SuperLU, which has the smallest growth, takes its place.

    Raises
    ------
    SolverError
        If the matrix is singular or has entries that are not numbers.
    """
    try:
        return best_available()(matrix)
    except SolverError:
        return factorize(matrix)
