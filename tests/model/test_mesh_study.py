"""Mesh studies of known convergence."""

from __future__ import annotations

import numpy as np
import pytest

from statorhom.errors import SolverError
from statorhom.model.mesh_study import mesh_study

LIMITS = np.array([60.0, 97.0, 137.0])


def frequencies(sizes: list[float], order: float) -> list[np.ndarray]:
    return [LIMITS * (1 + np.array([1, 2, 3]) * 1e-4 * size**order) for size in sizes]


@pytest.mark.parametrize("order", [1.5, 2.0, 2.7])
def test_an_exact_order_extrapolates_to_the_limit(order: float) -> None:
    sizes = [8.0, 6.0, 4.0]
    study = mesh_study(sizes, frequencies(sizes, order), [10.0, 20.0, 50.0])
    np.testing.assert_allclose(study.extrapolated_hz, LIMITS, rtol=1e-4)
    assert np.all(np.abs(study.extrapolated_hz - LIMITS) < study.sd_hz)
    np.testing.assert_allclose(study.error, frequencies(sizes, order) / study.extrapolated_hz - 1)
    assert np.all(study.change < 0)
    np.testing.assert_allclose(1 + study.total_change, np.prod(1 + study.change, axis=0))


def test_meshes_may_come_in_any_order() -> None:
    sizes = [8.0, 4.0, 6.0]
    study = mesh_study(sizes, frequencies(sizes, 2.0), [1 / 8**2, 1 / 4**2, 1 / 6**2])
    assert study.size.tolist() == [8.0, 6.0, 4.0]
    assert study.cost_order == pytest.approx(2.0)
    assert mesh_study(sizes, frequencies(sizes, 2.0)).cost_order is None


def test_rows_end_with_the_extrapolation() -> None:
    study = mesh_study([8.0, 4.0], frequencies([8.0, 4.0], 2.0), [55.0, 204.0])
    first, second, last = study.rows()
    assert (first["size"], second["seconds"], last["size"]) == (8.0, 204.0, 0.0)
    assert last["frequency_1_hz"] < second["frequency_1_hz"] < first["frequency_1_hz"]
    assert first["error_3_percent"] > second["error_3_percent"] > 0.0
    assert "seconds" not in last


@pytest.mark.parametrize(
    ("size", "values", "seconds", "words"),
    [
        ([8.0], [[60.0]], None, "two sizes"),
        ([8.0, 6.0], [[60.0]], None, "two sizes"),
        ([8.0, 8.0], [[60.0], [60.1]], None, "same element size"),
        ([8.0, 6.0], [[60.0], [-1.0]], None, "positive"),
        ([8.0, 6.0], [[60.0], [60.1]], [1.0], "2 meshes need 2 times"),
    ],
)
def test_what_is_no_study_is_one_clear_line(size, values, seconds, words) -> None:
    with pytest.raises(SolverError, match=words):
        mesh_study(size, values, seconds)
