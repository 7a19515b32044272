import numpy as np
import pytest
import scipy.sparse as sp
from scipy.linalg import eigh

from statorhom.errors import SolverError
from statorhom.model.eigen import factorize, frequency_hz, lowest_modes, modes_below


def _chain(n, free=True):
    """Unit masses and springs: λ_k = 4 sin²(k π / 2n) for a free chain."""
    main = np.full(n, 2.0)
    if free:
        main[[0, -1]] = 1.0
    return sp.diags_array([-np.ones(n - 1), main, -np.ones(n - 1)], offsets=[-1, 0, 1]).tocsr()


def _exact(n):
    return 4 * np.sin(np.arange(n) * np.pi / (2 * n)) ** 2


@pytest.mark.parametrize("expected", [1, 3, 8, 40])
def test_every_mode_below_the_limit_is_found_whatever_was_expected(expected):
    n = 200
    limit = np.sqrt(_exact(n)[23] * 1.0001) / (2 * np.pi)
    values, vectors = modes_below(_chain(n), sp.eye_array(n, format="csr"), limit, expected)
    assert len(values) == 24
    np.testing.assert_allclose(values, _exact(n)[:24], rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(vectors.T @ vectors, np.eye(24), atol=1e-9)


def test_no_mode_above_the_limit_is_returned():
    n = 50
    limit = np.sqrt(_exact(n)[7] * 0.9999) / (2 * np.pi)
    values, _ = modes_below(_chain(n), sp.eye_array(n, format="csr"), limit)
    assert len(values) == 7


def test_doublets_come_in_pairs():
    chain, identity = _chain(60), sp.eye_array(120, format="csr")
    double = sp.csr_array(sp.block_diag([chain, chain]))
    values, vectors = modes_below(double, identity, np.sqrt(_exact(60)[9] * 1.001) / (2 * np.pi), 3)
    np.testing.assert_allclose(values, np.repeat(_exact(60)[:10], 2), rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(vectors.T @ vectors, np.eye(20), atol=1e-8)


def test_vectors_are_normalised_by_the_mass():
    rng = np.random.default_rng(2)
    n = 80
    M = sp.csr_array(sp.diags_array(rng.uniform(1.0, 5.0, n)))
    K = _chain(n)
    values, vectors = lowest_modes(K, M, 6, 0.02)
    np.testing.assert_allclose(vectors.T @ (M @ vectors), np.eye(6), atol=1e-9)
    np.testing.assert_allclose(K @ vectors, (M @ vectors) * values, atol=1e-9)
    np.testing.assert_allclose(values, eigh(K.toarray(), M.toarray(), eigvals_only=True)[:6], atol=1e-10)


@pytest.mark.parametrize("n", [1, 2, 5])
def test_tiny_systems_are_solved_whole(n):
    values, vectors = modes_below(
        _chain(n) if n > 1 else sp.csr_array([[0.0]]), sp.eye_array(n, format="csr"), 10.0
    )
    np.testing.assert_allclose(values, _exact(n), atol=1e-12)
    assert vectors.shape == (n, n)


def test_the_same_matrices_give_the_same_digits():
    K, M = _chain(150), sp.eye_array(150, format="csr")
    first, second = modes_below(K, M, 0.05), modes_below(K, M, 0.05)
    np.testing.assert_array_equal(first[0], second[0])
    np.testing.assert_array_equal(first[1], second[1])


def test_the_factorization_solves():
    rng = np.random.default_rng(6)
    matrix = sp.csr_array(_chain(70) + 0.01 * sp.eye_array(70))
    right = rng.standard_normal((70, 3))
    np.testing.assert_allclose(matrix @ factorize(matrix)(right), right, atol=1e-11)


def test_a_failing_iteration_is_one_line_with_a_remedy():
    broken = _chain(60).copy()
    broken.data[5] = np.nan
    with pytest.raises(SolverError, match="check the materials") as caught:
        modes_below(broken, sp.eye_array(60, format="csr"), 1.0)
    assert "\n" not in str(caught.value)


def test_rounding_below_zero_is_a_rigid_body():
    np.testing.assert_allclose(frequency_hz(np.array([-1e-3, 0.0, (2 * np.pi * 50) ** 2])), [0, 0, 50])
