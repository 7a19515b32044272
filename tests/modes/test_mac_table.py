"""Modes paired by MAC, and the differences of their frequencies."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest

from statorhom.errors import IdentificationError
from statorhom.modes.mac_table import mac_table

X, Y = (one.ravel() for one in np.meshgrid(np.linspace(-1, 1, 11), np.linspace(-1, 1, 4)))


@dataclass(frozen=True)
class Mode:
    frequency_hz: float
    shape: np.ndarray


FIRST, SECOND, TWIST = X**2 - 1 / 3, X**3 - 0.6 * X, X * Y


def noisy(shape: np.ndarray, seed: int) -> np.ndarray:
    rng = np.random.default_rng(seed)
    return (shape + 0.05 * rng.standard_normal(shape.shape)) * np.exp(1j * seed)


def test_shapes_pair_where_frequencies_cross() -> None:
    """The model has torsion below the second bending, the structure above it."""
    measured = [Mode(50.3, noisy(FIRST, 1)), Mode(111.9, noisy(SECOND, 2)), Mode(125.0, noisy(TWIST, 3))]
    simulated = [Mode(60.4, FIRST), Mode(110.0, TWIST), Mode(138.0, SECOND), Mode(190.0, Y**2 - 0.5)]
    rows = mac_table(measured, simulated)
    assert [(row.measured, row.simulated) for row in rows] == [(0, 0), (1, 2), (2, 1), (None, 3)]
    assert all(row.mac is not None and row.mac > 0.9 for row in rows[:3])
    assert [row.difference_percent for row in rows[:3]] == pytest.approx([20.08, 23.32, 12.0], abs=0.01)
    assert rows[2].difference == pytest.approx(-0.12)
    assert rows[3].difference_percent is rows[3].mac is None


def test_what_is_not_alike_stays_alone() -> None:
    rows = mac_table([Mode(50.0, FIRST), Mode(60.0, TWIST)], [Mode(55.0, SECOND), Mode(400.0, TWIST)])
    assert [(row.measured, row.simulated) for row in rows] == [(0, None), (1, None), (None, 0), (None, 1)]
    (pair,) = mac_table([Mode(60.0, TWIST)], [Mode(400.0, TWIST)], largest_step=3.0)
    assert pair.mac == pytest.approx(1.0)


def test_without_modes_there_are_no_rows() -> None:
    assert mac_table([], []) == ()
    (row,) = mac_table([], [Mode(1.0, FIRST)])
    assert row.simulated == 0


def test_shapes_at_other_points_are_refused() -> None:
    with pytest.raises(IdentificationError, match="44 and at 3 points"):
        mac_table([Mode(1.0, FIRST)], [Mode(1.0, np.ones(3))])
    with pytest.raises(IdentificationError, match="least MAC"):
        mac_table([], [], least_mac=2.0)
