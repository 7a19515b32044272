"""Lower bounds of eigenvalues on matrices whose eigenvalues are known."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.linalg import eigh

from statorhom.model.eigenvalue_bounds import eigenvalue_drops, frequency_errors

SHIFT = 0.5


def ritz(values, noise, seed, count):
    """Ritz values of a noisy subspace of a matrix with the given eigenvalues, and their squared residuals."""
    rng = np.random.default_rng(seed)
    n = len(values)
    turn = np.linalg.qr(rng.standard_normal((n, n)))[0]
    K = turn * values @ turn.T
    space = np.linalg.qr(turn[:, :count] + noise * rng.standard_normal((n, count)) / np.sqrt(n))[0]
    found, q = eigh(space.T @ K @ space)
    x = space @ q
    r = K @ x - x * found
    return found, np.einsum("ij,ij->j", r, np.linalg.solve(K + SHIFT * np.eye(n), r))


@settings(max_examples=60, deadline=None)
@given(
    gaps=st.lists(st.floats(1e-6, 2.0), min_size=8, max_size=14),
    noise=st.floats(1e-6, 0.1),
    seed=st.integers(0, 10**6),
)
def test_no_eigenvalue_lies_below_its_bound(gaps, noise, seed):
    """Also where modes lie as close as 1e-6, as they do where two of them cross."""
    values = np.cumsum(gaps)
    found, squared = ritz(values, noise, seed, 5)
    drops = eigenvalue_drops(found, squared, SHIFT)
    shape = np.log(values[4]) if values[4] > 0 else 0.0
    assert np.isfinite(shape)
    if np.all(found[:4] / (1 + 1e-12) < values[1:5] + 1e-9):  # the subspace holds the lowest modes in order
        assert np.all(found - drops <= values[:5] + 1e-9)


def test_the_bound_is_sharp_and_quadratic():
    values = np.arange(1.0, 13.0)
    ratios = []
    for noise in (1e-2, 1e-3):
        found, squared = ritz(values, noise, 1, 5)
        drops = eigenvalue_drops(found, squared, SHIFT)
        true = found - values[:5]
        ratios.append(np.median(drops[:4] / true[:4]))
    assert all(1.0 <= ratio < 8.0 for ratio in ratios)


def test_a_close_pair_costs_nothing():
    apart = ritz(np.array([1.0, 2.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0]), 1e-3, 2, 4)
    close = ritz(np.array([1.0, 1.0 + 1e-9, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0]), 1e-3, 2, 4)
    drops = [eigenvalue_drops(*pair, SHIFT)[0] for pair in (apart, close)]
    assert drops[1] < 10 * drops[0]


def test_nothing_is_known_of_the_last_value_and_of_padding():
    values = np.array([[1.0, 2.0, 3.0], [1.0, 2.0, np.inf]]) * 1e6
    drops = eigenvalue_drops(values, np.full((2, 3), 1e-6), SHIFT)
    assert np.isfinite(drops[0]).tolist() == [True, True, False]
    assert np.isfinite(drops[1]).tolist() == [True, False, False]


def test_errors_of_frequencies():
    values, drops = np.array([1e6, 1e6, 1e6, 1e-3]), np.array([2e4, 2e6, np.inf, 1e-3])
    errors = frequency_errors(values, drops)
    # f̃/f ≤ √(1/0.98)
    assert np.sqrt(1 / 0.98) - 1 < errors[0] < 0.0103
    assert errors[1:].tolist() == [np.inf, np.inf, 0.0]


def test_without_residual_there_is_no_error():
    np.testing.assert_array_equal(eigenvalue_drops(np.array([1.0, 2.0, 3.0]), np.zeros(3), SHIFT)[:2], 0.0)
