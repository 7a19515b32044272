"""Poles that stay where they are when the model order grows: start values, and the data of the diagram."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from statorhom.extraction.plscf import plscf
from statorhom.extraction.point_grid import PointGrid

FloatArray = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]

_BAND_LINES = 1000
_HIGHEST_ORDER = 20
_MOST_ROOTS = 40  # order times references
_STABLE = 0.3  # distance to a pole of the next lower order, in half-power bandwidths
_SAME = 0.5  # distance of one pole's images over the orders
_LEAST_IMAGES = 3
_NEAR = 2.0
LEAST_SHARE = 0.25
"""Share of the orders that must show a mode."""


@dataclass(frozen=True)
class Stabilization:
    """Poles over model orders.

    Attributes
    ----------
    frequency_hz, loss_factor, order : arrays, shape (poles,)
        Of every pole of every order.
    stable : bool array, shape (poles,)
        Whether the next lower order has a pole in the same place.
    """

    frequency_hz: FloatArray
    loss_factor: FloatArray
    order: npt.NDArray[np.int_]
    stable: npt.NDArray[np.bool_]

    def share(self, squared: complex) -> float:
        """Share of the orders that have a stable pole near ω²(1 + iη), 0 … 1.

        Near means two half-power bandwidths: closer modes may show as one.
        """
        frequency = np.sqrt(squared.real) / (2 * np.pi)
        width = frequency * squared.imag / squared.real
        near = self.stable & (np.abs(self.frequency_hz - frequency) < _NEAR * width)
        orders = len(np.unique(self.order))
        return len(np.unique(self.order[near])) / orders if orders else 0.0

    @property
    def lasting_squared(self) -> ComplexArray:
        """ω²(1 + iη) of the stable poles that enough orders show ((rad/s)²)."""
        square = (2 * np.pi * self.frequency_hz[self.stable]) ** 2
        poles = square * (1 + 1j * self.loss_factor[self.stable])
        lasting = [pole for pole in poles.tolist() if self.share(pole) >= LEAST_SHARE]
        return np.array(lasting, dtype=complex)


def stabilize(grid: PointGrid, sd: FloatArray) -> tuple[ComplexArray, ComplexArray, Stabilization]:
    """Start poles ((rad/s)², shape (poles,)), their participations, and the stabilization diagram."""
    squared, parts, orders, stable = [], [], [], []
    for lines in _bands(len(grid.omega)):
        highest = max(
            4, min(_HIGHEST_ORDER, _MOST_ROOTS // len(grid.references), (lines.stop - lines.start) // 4)
        )
        previous = np.zeros(0, dtype=complex)
        for found in plscf(grid, sd, lines, highest):
            squared.append(found.squared)
            parts.append(found.participation)
            orders.append(np.full(len(found.squared), found.order))
            stable.append(_near_any(found.squared, previous))
            previous = found.squared
    every, part = np.concatenate(squared), np.concatenate(parts)
    is_stable = np.concatenate(stable)
    diagram = Stabilization(
        np.sqrt(every.real.clip(min=0.0)) / (2 * np.pi),
        every.imag / every.real,
        np.concatenate(orders),
        is_stable,
    )
    chosen = _images(every[is_stable])
    return every[is_stable][chosen], part[is_stable][chosen], diagram


def _bands(lines: int) -> list[slice]:
    """Bands of equal length that overlap by half."""
    if lines <= _BAND_LINES:
        return [slice(0, lines)]
    count = int(np.ceil(2 * lines / _BAND_LINES)) - 1
    starts = np.linspace(0, lines - _BAND_LINES, count).astype(int)
    return [slice(int(a), int(a) + _BAND_LINES) for a in starts]


def _near_any(poles: ComplexArray, others: ComplexArray) -> npt.NDArray[np.bool_]:
    if not len(others):
        return np.zeros(len(poles), dtype=bool)
    distance = np.abs(poles[:, None] - others[None]).min(axis=1)
    near: npt.NDArray[np.bool_] = distance < _STABLE * poles.imag
    return near


def _images(poles: ComplexArray) -> list[int]:
    """One of each crowd of poles, the largest crowds first."""
    near = np.abs(poles[:, None] - poles[None]) < _SAME * np.minimum(poles.imag[:, None], poles.imag[None])
    left = np.ones(len(poles), dtype=bool)
    chosen: list[int] = []
    while left.any():
        crowd = (near & left).sum(axis=1) * left
        best = int(np.argmax(crowd))
        if crowd[best] < _LEAST_IMAGES:
            break
        chosen.append(best)
        left &= ~near[best]
        left[best] = False
    return chosen
