"""All modes of a band of one large problem, and the check that none is missing."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from threadpoolctl import threadpool_limits

from statorhom.model.eigen import SHIFT, Factorize, Solve, frequency_hz, modes_below

EXPECTED = 32  # modes asked for first: a restart costs a whole body more than a few modes too many
CHECKED = 5  # modes asked for when the others are known
ROUGH = (
    1e-3  # tolerance that tells whether there is any; a quarter of the solves that all its digits would take
)


@dataclass(frozen=True)
class GeneralModes:
    """All modes of a band, rigid bodies included, sorted by frequency.

    Parameters
    ----------
    eigenvalues : (k,) λ = ω² (rad²/s²); rigid bodies' are zero but for rounding.
    vectors : (3 n, k) displacements in the frame's components, mass-normalised.
    """

    eigenvalues: np.ndarray
    vectors: np.ndarray

    def __post_init__(self) -> None:
        self.eigenvalues.setflags(write=False)
        self.vectors.setflags(write=False)

    @property
    def frequencies_hz(self) -> np.ndarray:
        """(k,) natural frequencies."""
        return frequency_hz(self.eigenvalues)


def band_modes(
    K: sp.csr_array, M: sp.csr_array, highest_hz: float, back_end: Factorize, expected: int = EXPECTED
) -> GeneralModes:
    """All modes up to a frequency, with one factorization of K + σ M, σ > 0.

    Raises
    ------
    SolverError
        If K + σ M is not positive definite, or if the iteration does not converge.
    """
    with threadpool_limits(limits=1, user_api="blas"):
        solve = back_end(shifted(K, M, highest_hz))
    values, vectors = modes_below(K, M, highest_hz, expected, back_end=lambda _: solve)
    return with_missed(K, M, highest_hz, GeneralModes(values, vectors), solve)


def shifted(K: sp.csr_array, M: sp.csr_array, highest_hz: float) -> sp.csr_array:
    """K + σ M with the shift of `modes_below`."""
    return sp.csr_array(K + SHIFT * (2 * np.pi * highest_hz) ** 2 * M)


def with_missed(
    K: sp.csr_array, M: sp.csr_array, highest_hz: float, modes: GeneralModes, solve: Solve
) -> GeneralModes:
    """Add the modes of the band that are missing.

    A Krylov space holds one vector of each eigenvalue but for rounding: a doublet's second member may come late.
    With the known modes projected out it is the next to be found. `solve` is that of the `shifted` matrix.
    """
    n = K.shape[0]
    while len(modes.eigenvalues) < n - 4 * CHECKED:  # a body that small was solved whole
        rest = _without(modes.vectors, M, solve)
        if len(modes_below(K, M, highest_hz, CHECKED, back_end=rest, tolerance=ROUGH)[0]) == 0:
            break
        found, more = modes_below(K, M, highest_hz, CHECKED, back_end=rest)
        values = np.r_[modes.eigenvalues, found]
        order = np.argsort(values)
        modes = GeneralModes(values[order], np.hstack([modes.vectors, more])[:, order])
    return modes


def _without(known: np.ndarray, M: sp.csr_array, solve: Solve) -> Factorize:
    """What solves in the space of the modes that are not known yet."""
    images = M @ known

    def solve_rest(right: np.ndarray) -> np.ndarray:
        x = solve(right)
        return np.asarray(x - known @ (images.T @ x))

    return lambda _: solve_rest
