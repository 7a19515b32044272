"""Frequency shifts from FRF to FRF, as a roving sensor's mass makes them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from statorhom.extraction import extract, local_poles
from synthetic_frfs import frf_set, ring_points, ring_shape

POINTS = ring_points(8, 2)
AXIS = np.arange(900.0, 1300.0)
SHAPE = 1.5 + ring_shape(POINTS, 2, 0.2)


def test_shifts_of_single_frfs_are_found_with_their_uncertainty() -> None:
    shifts = np.linspace(-4e-4, 4e-4, len(POINTS))
    whole = frf_set(AXIS, POINTS, [0], [(1100.0, 0.01)], SHAPE[None], noise=0.003)
    rows = []
    for k, shift in enumerate(shifts):
        one = frf_set(AXIS, POINTS, [0], [(1100.0 * (1 + shift), 0.01)], SHAPE[None], noise=0.003, seed=k)
        rows.append(one.accelerance[k])
    moved = replace(whole, accelerance=np.array(rows))
    extraction = extract(moved)
    assert len(extraction.modes) == 1
    local = local_poles(extraction, moved)
    found = local.relative_shift[0] + extraction.modes[0].frequency_hz / 1100.0 - 1.0
    assert np.all(np.abs(found - shifts) < 5 * local.relative_shift_sd[0])
    assert np.all(local.relative_shift_sd[0] < 3e-5)
