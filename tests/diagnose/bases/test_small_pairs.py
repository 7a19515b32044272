"""Small eigenproblems without a wrapper."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.linalg import eigh

from statorhom.diagnose.bases.small_pairs import small_pairs
from statorhom.errors import SolverError


@pytest.mark.parametrize("size", [0, 1, 7])
def test_pairs_are_those_of_the_library(size: int) -> None:
    rng = np.random.default_rng(size)
    A, B = rng.standard_normal((2, size, 2 * size))
    K, M = A @ A.T, B @ B.T
    values, vectors = small_pairs(K, M)
    np.testing.assert_allclose(vectors.T @ M @ vectors, np.eye(size), atol=1e-10)
    np.testing.assert_allclose(K @ vectors, M @ vectors * values, atol=1e-8 * (1 + np.abs(K).max(initial=0)))
    if size:
        np.testing.assert_allclose(values, eigh(K, M, eigvals_only=True), rtol=1e-9)


def test_a_mass_that_is_not_definite_is_refused() -> None:
    with pytest.raises(SolverError, match="must be positive"):
        small_pairs(np.eye(2), np.diag([1.0, -1.0]))
