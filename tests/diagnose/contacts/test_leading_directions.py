"""Directions that hold most of many columns, against a full decomposition of them."""

from __future__ import annotations

import numpy as np
import pytest

from statorhom.diagnose.contacts.leading_directions import SPARE, leading_directions, sketch

MOST = 20


def columns(rows: int, parts: int, each: int) -> tuple[np.ndarray, list[np.ndarray]]:
    """Singular values that fall by a fifth from one to the next, and matrices that have them together."""
    rng = np.random.default_rng(4)
    values = 0.8 ** np.arange(min(rows, parts * each))
    left = np.linalg.qr(rng.standard_normal((rows, len(values))))[0]
    right = np.linalg.qr(rng.standard_normal((parts * each, len(values))))[0]
    return values, np.split(left * values @ right.T, parts, axis=1)


def directions(found: list[np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    return leading_directions(np.asarray(sum(sketch(part, MOST) for part in found)), MOST)


@pytest.mark.parametrize(("rows", "parts"), [(30, 3), (2 * (MOST + SPARE) + 60, 40)])
def test_they_are_the_singular_vectors_of_the_largest_values(rows: int, parts: int) -> None:
    values, found = columns(rows, parts, 7)
    left, sizes = directions(found)
    count = min(MOST, len(values))
    assert left.shape == (rows, count) and left.T @ left == pytest.approx(np.eye(count), abs=1e-10)
    assert sizes == pytest.approx(values[:count], rel=1e-6)
    # what they leave of all columns is what the smaller values are
    whole = np.hstack(found)
    rest = np.linalg.norm(whole - left @ (left.T @ whole))
    assert rest == pytest.approx(np.linalg.norm(values[count:]), rel=1e-4, abs=1e-12)


def test_the_same_columns_give_the_same_directions() -> None:
    _, found = columns(2 * (MOST + SPARE) + 60, 40, 7)
    once, again = (directions(found)[0] for _ in range(2))
    assert np.array_equal(once, again)
