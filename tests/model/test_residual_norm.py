"""The factored norm of residuals against the norm itself."""

import numpy as np
import pytest

from statorhom.model.residual_norm import residual_norm, squared_norms


@pytest.mark.parametrize("negligible", [1e-12, 1e-2])
def test_norms_are_those_of_the_images_and_never_too_small(negligible):
    rng = np.random.default_rng(0)
    t, k, n = 3, 4, 40
    images = rng.standard_normal((t, n, k)) * np.logspace(0, -3, t)[:, None, None]
    flat = images.transpose(1, 0, 2).reshape(n, -1)
    energies = np.array([1.0, 3.0, 10.0, 40.0])
    norm = residual_norm((flat.T @ flat).reshape(t, k, t, k), np.ones(t), energies, negligible)
    weights, density = np.array([0.7, -1.3]), 0.4
    values = np.array([0.1, 2.0])
    vectors = rng.standard_normal((k, 2))
    exact = np.tensordot(weights, images[:2] @ vectors, axes=1) - density * (images[2] @ vectors) * values
    expected = np.sum(exact**2, axis=0)
    rest = norm.dropped * (np.sum(weights**2) + (density * values) ** 2) * (energies @ vectors**2)
    found = squared_norms(
        np.tensordot(weights, norm.factor[:2], axes=1), density * norm.factor[2], rest, values, vectors
    )
    assert np.all(found >= expected)
    if negligible < 1e-6:
        np.testing.assert_allclose(found, 1.1 * expected, rtol=1e-3)
    else:
        assert norm.factor.shape[1] < t * k
