"""Measured and simulated modes side by side: paired by MAC, with the differences of their frequencies.

For bodies whose modes have no circumferential order, and shapes at common points. The difference is that of the
flying wing's and the wing's tables, |simulated − measured| / measured (equation 11 of the latter), with its sign.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
import numpy.typing as npt
from scipy.optimize import linear_sum_assignment

from statorhom.errors import IdentificationError
from statorhom.modes.mac import mac_matrix

FloatArray = npt.NDArray[np.float64]

LEAST_MAC = 0.5  # of a pair
LARGEST_STEP = 0.5  # of ln f between the modes of a pair


class ShapedMode(Protocol):
    """A mode with a frequency and a shape, real or complex, (points, …)."""

    @property
    def frequency_hz(self) -> float: ...
    @property
    def shape(self) -> npt.ArrayLike: ...


@dataclass(frozen=True)
class MacRow:
    """A pair, or a mode without a partner.

    Attributes
    ----------
    measured, simulated : int or None
        Positions of the modes; None where one has no partner.
    measured_hz, simulated_hz : float or None
    difference : float or None
        (simulated − measured)/measured.
    mac : float or None
    """

    measured: int | None
    simulated: int | None
    measured_hz: float | None
    simulated_hz: float | None
    difference: float | None = None
    mac: float | None = None

    @property
    def difference_percent(self) -> float | None:
        """|difference| · 100 %, as the seeds print it."""
        return None if self.difference is None else 100 * abs(self.difference)


def difference(simulated: npt.ArrayLike, measured: npt.ArrayLike) -> FloatArray:
    """(simulated − measured)/measured."""
    reference = np.asarray(measured, dtype=float)
    return np.asarray((np.asarray(simulated, dtype=float) - reference) / reference)


def mac_table(
    measured: Sequence[ShapedMode],
    simulated: Sequence[ShapedMode],
    least_mac: float = LEAST_MAC,
    largest_step: float = LARGEST_STEP,
) -> tuple[MacRow, ...]:
    """Pair the modes so that the sum of their MACs is the largest.

    Parameters
    ----------
    measured, simulated : sequences of modes
        Shapes at the same points, in the same directions.
    least_mac : float
        Below it, modes stay without a partner.
    largest_step : float
        Of |ln f| between the modes of a pair: few points make shapes alike that have nothing in common.

    Returns
    -------
    tuple of MacRow
        Pairs and measured modes in the order of the measured ones, then what is left of the simulated ones.

    Raises
    ------
    IdentificationError
        When shapes are not at the same points or one does not move.
    """
    if not 0.0 <= least_mac <= 1.0:
        raise IdentificationError(f"the least MAC of a pair lies between 0 and 1, not at {least_mac:g}")
    values = _macs(measured, simulated)
    step = (
        np.log([one.frequency_hz for one in simulated])[None]
        - np.log([one.frequency_hz for one in measured])[:, None]
    )
    values = np.where((values >= least_mac) & (np.abs(step) <= largest_step), values, 0.0)
    partner = {
        int(i): int(j) for i, j in zip(*linear_sum_assignment(-values), strict=True) if values[i, j] > 0
    }
    rows = [_row(i, partner.get(i), measured, simulated, values) for i in range(len(measured))]
    left = sorted(set(range(len(simulated))) - set(partner.values()))
    return tuple([*rows, *(MacRow(None, j, None, float(simulated[j].frequency_hz)) for j in left)])


def _macs(measured: Sequence[ShapedMode], simulated: Sequence[ShapedMode]) -> FloatArray:
    sides = [[np.asarray(one.shape).ravel() for one in side] for side in (measured, simulated)]
    return mac_matrix(*sides).reshape(len(measured), len(simulated))


def _row(
    i: int, j: int | None, measured: Sequence[ShapedMode], simulated: Sequence[ShapedMode], values: FloatArray
) -> MacRow:
    first = float(measured[i].frequency_hz)
    if j is None:
        return MacRow(i, None, first, None)
    second = float(simulated[j].frequency_hz)
    return MacRow(i, j, first, second, float(difference(second, first)), float(values[i, j]))
