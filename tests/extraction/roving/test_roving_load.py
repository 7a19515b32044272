"""The load of a roving sensor against exact solutions of small systems with the mass attached."""

from __future__ import annotations

import numpy as np
import pytest

from statorhom.extraction.roving.load import RovingLoad, load_of
from statorhom.extraction.roving.rings import Rings, rings
from synthetic_frfs import LENGTH_M, ring_points

POLES = np.array([1.0, 1.6]) * 4e7 * (1 + 0.006j)
LOADS = np.array([[0.012, 0.003], [0.002, 0.020]])
POINTS = ring_points(12, 2)


def placed() -> Rings:
    found = rings(POINTS)
    assert found is not None
    return found


def load(split: float = 0.0) -> RovingLoad:
    splits = np.zeros((2, 2))
    splits[0] = split * np.array([np.cos(4 * 0.2), np.sin(4 * 0.2)])
    none = np.zeros(2)
    return RovingLoad(POLES, np.array([2, 3]), LOADS, np.zeros((2, 2)), splits, none, placed())


def test_shifts_are_those_of_the_loaded_eigenproblem() -> None:
    """Modal coordinates with the mass: Λ q = λ (I + b bᵀ) q, for all amplitudes are at the sensor's place."""
    for plane, column in enumerate(LOADS.T):
        amplitude = np.sqrt(column)
        added = np.eye(2) + np.outer(amplitude, amplitude)
        exact = np.sort(np.linalg.eigvals(np.linalg.solve(added, np.diag(POLES.real))).real)
        found = POLES.real * (1 + load().relative_shifts()[:, plane]) ** 2
        np.testing.assert_allclose(found, exact, rtol=1e-9)


def test_loads_follow_from_where_they_move_the_poles() -> None:
    loaded = POLES * (1 + load().relative_shifts()[:, 0]) ** 2
    np.testing.assert_allclose(load_of(loaded, POLES).real, LOADS[:, 0], rtol=1e-6)


def test_the_denominator_is_one_less_the_mass_s_share_of_its_own_receptance() -> None:
    """Two halves of a split doublet of order 2, and one of order 3 that is not split."""
    split, squared = 1e-3, np.array([0.9, 1.01, 1.3]) * 4e7
    found = load(split).denominator(squared)
    for point, dof in enumerate(POINTS):
        assert dof.angle is not None
        b = LOADS[:, placed().plane[point]]
        shares = np.cos(2 * (dof.angle - 0.2)) ** 2 * b[0], np.sin(2 * (dof.angle - 0.2)) ** 2 * b[0], b[1]
        poles = POLES[0] * (1 - split / 2), POLES[0] * (1 + split / 2), POLES[1]
        exact = 1 - sum(share * squared / (pole - squared) for share, pole in zip(shares, poles, strict=True))
        np.testing.assert_allclose(found[point], exact, rtol=1e-12)


def test_rings_are_planes_of_radial_sensors() -> None:
    found = placed()
    np.testing.assert_allclose(found.heights_m, [0.25 * LENGTH_M, 0.75 * LENGTH_M])
    assert [len(one) for one in found.members] == [12, 12]
    assert found.highest_order == 5


@pytest.mark.parametrize("points", [ring_points(12, 1), ring_points(5, 3)])
def test_one_plane_or_few_points_are_no_rings(points: list) -> None:
    assert rings(points) is None
