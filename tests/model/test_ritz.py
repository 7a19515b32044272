"""Small dense eigenproblems."""

import numpy as np
import pytest

from statorhom.model.ritz import ritz_pairs


@pytest.mark.parametrize("unit_mass", [True, False])
def test_pairs_of_a_stack_of_problems(unit_mass):
    root = np.random.default_rng(4).standard_normal((3, 9, 9))
    K = root @ root.transpose(0, 2, 1)
    M = np.eye(9) + (0.0 if unit_mass else 0.05) * (root + root.transpose(0, 2, 1))
    values, vectors = ritz_pairs(K, None if unit_mass else M)
    assert np.all(np.diff(values) >= 0)
    np.testing.assert_allclose(K @ vectors, (M @ vectors) * values[:, None], atol=1e-9 * np.abs(K).max())
    np.testing.assert_allclose(vectors.transpose(0, 2, 1) @ M @ vectors, [np.eye(9)] * 3, atol=1e-9)
