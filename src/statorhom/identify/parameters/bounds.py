"""A box in internal coordinates and the reflection that keeps a random walk inside it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def read_only(values: object) -> Array:
    """Return a private copy of `values` as floats that nobody can write to."""
    array = np.array(values, dtype=np.float64)
    array.setflags(write=False)
    return array


@dataclass(frozen=True, eq=False)
class Bounds:
    """Lower and upper limits of every coordinate; infinite ones are allowed.

    Parameters
    ----------
    lower, upper : array, shape (d,)
        ``lower < upper`` in every coordinate.

    Raises
    ------
    ValueError
        Where a limit is not a number or the box is empty.
    """

    lower: Array
    upper: Array

    def __post_init__(self) -> None:
        object.__setattr__(self, "lower", read_only(self.lower))
        object.__setattr__(self, "upper", read_only(self.upper))
        if self.lower.shape != self.upper.shape or self.lower.ndim != 1:
            raise ValueError("lower and upper bounds must be vectors of the same length")
        if not np.all(self.lower < self.upper):
            raise ValueError("every lower bound must lie below its upper bound")

    @property
    def dimension(self) -> int:
        """Number of coordinates."""
        return self.lower.size

    @property
    def width(self) -> Array:
        """Extent of every coordinate, infinite where a side is open."""
        return self.upper - self.lower

    def contains(self, x: Array) -> bool:
        """Tell whether `x` lies in the closed box."""
        return bool(np.all(x >= self.lower) and np.all(x <= self.upper))

    def clip(self, x: Array) -> Array:
        """Return the point of the box nearest to `x`."""
        return np.clip(x, self.lower, self.upper)

    def reflect(self, x: Array) -> Array:
        """Fold `x` back into the box as if the limits were mirrors.

        Unlike clipping this leaves a symmetric proposal symmetric, so that a chain does not
        stick to the limits.

        Parameters
        ----------
        x : array, shape (..., d)

        Returns
        -------
        array, shape (..., d)
        """
        closed = np.isfinite(self.width)
        width = np.where(closed, self.width, 1.0)
        base = np.where(closed, self.lower, 0.0)
        phase = np.mod(np.where(closed, x - base, 0.0), 2.0 * width)
        folded = base + width - np.abs(phase - width)
        half_open = np.where(x < self.lower, 2.0 * self.lower - x, x)
        half_open = np.where(half_open > self.upper, 2.0 * self.upper - half_open, half_open)
        return self.clip(np.where(closed, folded, half_open))
