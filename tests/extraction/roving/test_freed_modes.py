"""Exact FRFs under a heavy roving sensor: the structure without it, to the last doublet."""

from __future__ import annotations

import numpy as np
import pytest

from roving_sensor import LINES, MASS_KG, POLES, directions, loaded_frfs, loaded_from_hammers, shapes
from statorhom.extraction import Extraction, extract
from statorhom.extraction.doublet_motion import whole_doublets
from statorhom.recordings.frf_set import FrfSet
from synthetic_frfs import ring_points

POINTS = ring_points(12, 4)
HAMMERS = (1, 18)
SPLIT = 3e-4  # of both doublets' frequencies


def from_two_hammers() -> FrfSet:
    """A sensor that moves poles by a whole bandwidth, in three directions; doublets split by a tenth of that."""
    poles, modes = shapes(POINTS)
    poles = [(f * (1 + SPLIT * (i % 2)), loss) for i, (f, loss) in enumerate(poles)]
    return loaded_from_hammers(LINES, POINTS, HAMMERS, poles, modes, directions(POINTS), (0.004, 3e-4))


@pytest.fixture(scope="module")
def frfs() -> FrfSet:
    return from_two_hammers()


@pytest.fixture(scope="module")
def found(frfs: FrfSet) -> Extraction:
    return extract(frfs)


def test_every_mode_stands_once_and_none_is_invented(found: Extraction) -> None:
    assert found.loaded is not None
    free = [found.loaded.free.modes[i].frequency_hz for i in range(4)]
    exact = [f * (1 + half) for f, _ in POLES for half in (0.0, SPLIT)]
    assert len(found.modes) == 4
    np.testing.assert_allclose(free, exact, rtol=3e-3)
    # the split is far better known than where the doublet lies without the sensor
    assert free[1] / free[0] - 1 == pytest.approx(SPLIT, rel=0.1)


def test_loads_are_mass_times_squared_motion(found: Extraction) -> None:
    """Between the planes; what both halves carry alike is part of where the doublet lies."""
    assert found.loaded is not None
    moved = directions(POINTS)
    for number, first in enumerate((0, 2)):
        square = sum(np.sum(moved[first + half][:, [0, 2]] ** 2, axis=1) for half in (0, 1))
        load = found.loaded.load.load[number]
        np.testing.assert_allclose(np.ptp(load), MASS_KG * np.ptp(square), atol=0.05 * MASS_KG)


def test_the_frfs_under_the_sensor_are_met(found: Extraction, frfs: FrfSet) -> None:
    error = np.abs(found.regenerate(LINES) - frfs.receptance) / np.abs(frfs.receptance).max()
    assert error.max() < 0.02


def test_halves_of_a_doublet_become_one_that_the_sensor_moves(found: Extraction) -> None:
    assert found.loaded is not None
    modes, partners = whole_doublets(found.modes, found.loaded)
    assert len(partners) == 2
    assert sum(mode.shift is not None for mode in modes) == 2
    for weaker, (stronger, ratio) in partners.items():
        assert modes[weaker].frequency_hz == pytest.approx(ratio * modes[stronger].frequency_hz)


def test_a_light_sensor_leaves_a_recording_as_it_is() -> None:
    assert extract(loaded_frfs(POINTS, mass_kg=0.0)).loaded is None
