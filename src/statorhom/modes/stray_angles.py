"""Points beside an otherwise equidistant grid, such as the place of the hammer."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

BoolArray = npt.NDArray[np.bool_]

_LEAST_ON_GRID = 0.8
_LEAST_OCCUPIED = 0.8
_LARGEST_OFFSET = 0.1  # of the spacing
_LEAST_POSITIONS = 3


def stray_angles(angles_rad: npt.ArrayLike) -> BoolArray:
    """Which angles lie beside the equidistant grid that nearly all others make.

    One such point would turn the grid into one of twice as many, half empty positions, on which nothing
    can be told any more.

    Parameters
    ----------
    angles_rad : array_like, shape (angles,)
        Different angles (rad).

    Returns
    -------
    ndarray of bool, shape (angles,)
        All False where there is no such grid.
    """
    angles = np.asarray(angles_rad, dtype=float)
    fewest = max(_LEAST_POSITIONS, int(np.ceil(_LEAST_ON_GRID * angles.size)))
    for count in range(fewest, angles.size):
        turns = np.exp(1j * count * angles)
        # the median direction is not moved by the strays
        phase = np.angle(np.median(turns.real) + 1j * np.median(turns.imag))
        offset = np.angle(turns * np.exp(-1j * phase)) / (2 * np.pi)
        on_grid = np.abs(offset) <= _LARGEST_OFFSET
        positions = np.unique(np.rint((count * angles - phase) / (2 * np.pi))[on_grid] % count).size
        if on_grid.sum() >= _LEAST_ON_GRID * angles.size and positions >= _LEAST_OCCUPIED * count:
            return ~on_grid
    return np.zeros(angles.size, dtype=bool)
