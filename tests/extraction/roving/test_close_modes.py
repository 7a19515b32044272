"""A heavy roving sensor where modes of different orders lie closer than the sensor moves them apart."""

from __future__ import annotations

from dataclasses import replace
from importlib import import_module

import numpy as np
import pytest

from roving_sensor import loaded_from_hammers
from statorhom.extraction.mode_search import ModeSearch
from statorhom.extraction.noise import expected_sd, noise_sd
from statorhom.extraction.point_grid import point_grid
from statorhom.extraction.roving.find_load import find_load
from statorhom.extraction.roving.plane_alignment import aligned
from statorhom.extraction.roving.plane_poles import plane_poles
from statorhom.extraction.roving.plane_starts import plane_starts
from statorhom.extraction.roving.rings import Rings, rings
from statorhom.extraction.stabilization import stabilize
from statorhom.recordings.frf_set import FrfSet
from synthetic_frfs import ring_points, ring_shape

POINTS = ring_points(12, 4)
HAMMERS = (1, 18)
LINES = np.arange(850.0, 1750.0)
LOSS, MASS_KG = 0.004, 0.005
DOUBLETS = ((1000.0, 2, 0), (1009.0, 3, 1), (1600.0, 2, 1), (1613.0, 4, 0))  # hertz, r, n; 4 and 6 Hz broad
SPLIT = 2e-4


def shapes() -> np.ndarray:
    """Mass-normalised radial shapes, both halves of every doublet, (modes, points)."""
    return np.array(
        [
            ring_shape(POINTS, order, 0.1 + turn * np.pi / (2 * order), axial)
            for _, order, axial in DOUBLETS
            for turn in (0, 1)
        ]
    )


@pytest.fixture(scope="module")
def frfs() -> FrfSet:
    poles = [(f * (1 + SPLIT * half), LOSS) for f, _, _ in DOUBLETS for half in (0, 1)]
    radial = shapes()
    moved = np.stack([radial, np.zeros_like(radial), np.zeros_like(radial)], axis=2)
    return loaded_from_hammers(LINES, POINTS, HAMMERS, poles, radial, moved, (0.001, 3e-5), MASS_KG)


@pytest.fixture(scope="module")
def search(frfs: FrfSet) -> ModeSearch:
    grid = point_grid([frfs])
    sd = expected_sd(grid, noise_sd(grid))
    poles, parts, stabilization = stabilize(grid, sd)
    return ModeSearch(grid, sd, poles, parts, stabilization.lasting_squared)


@pytest.fixture(scope="module")
def placed() -> Rings:
    found = rings(POINTS)
    assert found is not None
    return found


def test_every_plane_shows_each_doublet_once(search: ModeSearch, placed: Rings) -> None:
    start = plane_starts(search, placed)
    assert start.shape == (4, len(DOUBLETS))
    frequency = np.sqrt(start.real * search.unit) / (2 * np.pi)
    exact = np.array([f for f, _, _ in DOUBLETS])
    assert np.all(np.abs(frequency - exact) < 0.006 * exact)


def test_a_load_is_found_though_the_first_look_takes_two_doublets_for_one(
    search: ModeSearch, monkeypatch: pytest.MonkeyPatch
) -> None:
    module = import_module("statorhom.extraction.roving.find_load")
    first = search.first_look()
    assert len(module._start(first)) < len(DOUBLETS)
    load = find_load(search, first)
    assert load is not None
    assert load.orders.tolist() == [order for _, order, _ in DOUBLETS]
    square = shapes() ** 2
    plane = load.rings.plane
    for number in range(len(DOUBLETS)):
        own = square[2 * number] + square[2 * number + 1]
        of_plane = MASS_KG * np.array([own[plane == z].mean() for z in range(4)])
        # what all planes have in common says where the doublet lies without the sensor, and is known less well
        np.testing.assert_allclose(np.ptp(load.load[number]), np.ptp(of_plane), atol=0.2 * of_plane.max())
    monkeypatch.setattr(module, "plane_starts", lambda *_: np.zeros((4, 0), dtype=complex))
    assert find_load(search, first) is None


def test_planes_whose_fits_began_at_each_other_s_poles_are_put_right(
    search: ModeSearch, placed: Rings
) -> None:
    found = plane_poles(search, plane_starts(search, placed), placed)
    mixed = replace(
        found, poles=found.poles.copy(), residues=found.residues.copy(), misfit=found.misfit.copy()
    )
    rows, turned = placed.members[2], [1, 0, 2, 3]
    mixed.poles[2] = found.poles[2, turned]
    mixed.misfit[2] = found.misfit[2, turned]
    mixed.residues[rows] = found.residues[rows][..., turned]
    back = aligned(mixed, placed)
    np.testing.assert_array_equal(back.poles, found.poles)
    np.testing.assert_array_equal(back.residues, found.residues)
