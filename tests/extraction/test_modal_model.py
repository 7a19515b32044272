"""Products of columns, with weights of every point."""

from __future__ import annotations

import numpy as np
import pytest

from statorhom.extraction.modal_model import weighted_gram, weighted_products


@pytest.mark.parametrize("points", [3, 20], ids=["point by point", "all points at once"])
@pytest.mark.parametrize("own", [False, True], ids=["columns that all points share", "columns of each point"])
def test_the_gram_matrix_is_the_product_of_columns_with_themselves(points: int, own: bool) -> None:
    rng = np.random.default_rng(0)
    shape = (points if own else 1, 5, 40)
    a = rng.normal(size=shape) + 1j * rng.normal(size=shape)
    weights = rng.random((points, 40))
    expected = np.einsum(
        "pd,pcd,ped->pce", weights, np.broadcast_to(a.conj(), (points, 5, 40)), a + 0 * weights[:, None]
    )
    assert np.allclose(weighted_gram(weights, a), expected, rtol=1e-12, atol=1e-12)
    assert np.allclose(weighted_products(weights, a, a), expected, rtol=1e-12, atol=1e-12)
