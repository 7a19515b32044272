"""Poles that settle from hammer point to hammer point, and those that only seem to move."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from statorhom.extraction import extract
from statorhom.extraction.moving_modes import most_move
from statorhom.recordings.frf_set import FrfSet
from synthetic_frfs import frf_set, ring_points, ring_shape

POINTS = ring_points(8, 1)
LINES = np.arange(850.0, 1750.0)
POLES = [(1000.0, 0.006), (1500.0, 0.008)]
SHAPES = np.array([ring_shape(POINTS, 2, 0.2), ring_shape(POINTS, 3, 0.1)])
HAMMERS = [0, 1, 3, 6]
DRIFT = np.array([-4e-4, -1e-4, 1e-4, 3e-4])
DAMPED = np.array([0.9, 0.95, 1.05, 1.2])


def drifting() -> FrfSet:
    """Every hammer point with its own frequencies and loss factors."""
    sets = []
    for hammer, shift, factor in zip(HAMMERS, DRIFT, DAMPED, strict=True):
        poles = [(frequency * (1 + shift), loss * factor) for frequency, loss in POLES]
        sets.append(frf_set(LINES, POINTS, [hammer], poles, SHAPES, noise=0.001, seed=hammer))
    return replace(
        sets[0],
        responses=tuple(dof for one in sets for dof in one.responses),
        references=tuple(dof for one in sets for dof in one.references),
        accelerance=np.concatenate([one.accelerance for one in sets]),
    )


def test_modes_that_move_with_the_reference_stay_one() -> None:
    found = extract(drifting())
    assert len(found.modes) == len(POLES)
    for mode, (frequency, loss) in zip(found.modes, POLES, strict=True):
        assert mode.shift is not None and mode.shift.shape == (1, len(HAMMERS))
        assert mode.frequency_hz == pytest.approx(frequency, rel=2e-4)
        assert mode.loss_factor == pytest.approx(loss, rel=0.05)
        np.testing.assert_allclose(np.ptp(mode.shift.real), np.ptp(DRIFT), rtol=0.1)
    frfs = drifting()
    error = np.abs(found.regenerate(LINES) - frfs.receptance) / np.abs(frfs.receptance).max()
    assert error.max() < 5e-3


def test_a_doublet_that_one_reference_cannot_resolve_is_one_mode_and_is_said() -> None:
    shapes = np.array([SHAPES[0], ring_shape(POINTS, 2, 0.2 + np.pi / 4), SHAPES[1]])
    poles = [(1000.0, 0.008), (1000.12, 0.008), (1500.0, 0.008)]
    found = extract(frf_set(LINES, POINTS, [1], poles, shapes, noise=0.003))
    assert len(found.modes) == 2
    assert found.modes[0].frequency_hz == pytest.approx(1000.06, abs=0.1)
    assert all(mode.shift is None for mode in found.modes)


def test_a_mode_that_is_but_a_trace_is_not_listed_where_the_model_limits_the_fit() -> None:
    """Noise far below what a linear model explains: a pole of one part in a thousand may be anything."""
    shapes = np.array([*SHAPES, 0.02 * ring_shape(POINTS, 4, 0.3)])
    frfs = frf_set(LINES, POINTS, [0], [*POLES, (1240.0, 0.01)], shapes, noise=1e-4, floor_db=-140.0)
    found = extract(frfs)
    assert [round(mode.frequency_hz) for mode in found.modes] == [1000, 1500]


def test_a_promise_from_afar_is_dropped_where_the_windows_do_not_keep_it() -> None:
    assert most_move([False] * 3)  # too few to tell
    assert not most_move([False] * 4)
    assert most_move([True, False, False, True])
    assert not most_move([True, False, False, False])
