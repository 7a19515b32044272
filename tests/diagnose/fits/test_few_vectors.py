"""Points whose modes span the few vectors around optima."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np

from statorhom.diagnose.fits.few_vectors import NEAR, REACH, with_neighbours

BOUNDED: Any = SimpleNamespace(limits=lambda: (np.full(3, -2.0), np.full(3, 2.0)))


def test_neighbours_lie_on_all_sides_of_every_point_in_the_places_that_move() -> None:
    points = [np.array([0.5, 0.0, -1.0]), np.array([-0.5, 1.0, 1.0])]
    found = with_neighbours(BOUNDED, points, [1, 2])
    assert len(found) == 2 * (1 + NEAR)
    for point, own in zip(points, (found[: 1 + NEAR], found[1 + NEAR :]), strict=True):
        assert np.array_equal(own[0], point)
        away = np.array(own) - point
        assert not away[:, 0].any()
        assert (away[:, 1:].min(axis=0) < -0.8 * REACH).all() and (
            away[:, 1:].max(axis=0) > 0.8 * REACH
        ).all()
        assert np.abs(away).max() <= REACH


def test_no_neighbour_leaves_the_limits() -> None:
    found = np.array(with_neighbours(BOUNDED, [np.array([0.0, 2.0, -2.0])], [0, 1, 2]))
    assert np.abs(found).max() == 2.0
