"""The equidistant grid of angles on which points round the circumference lie."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from statorhom.errors import IdentificationError

FloatArray = npt.NDArray[np.float64]

SAME_ANGLE_RAD = 1e-3
"""Angles closer than this are one point that was measured twice."""

_LEAST_ANGLES = 3
_LEAST_COHERENCE = 0.9  # angles scattered by less than about 7 % of the spacing still make a grid


@dataclass(frozen=True)
class CircumferentialGrid:
    """Positions round the circumference.

    Attributes
    ----------
    count : int
        Positions of the equidistant grid, occupied or not; without such a grid the number of
        different angles.
    offset_rad : float
        Angle of the grid's first position (rad); 0 without a grid.
    equidistant : bool
        Whether the angles lie on an equidistant grid at all.
    """

    count: int
    offset_rad: float
    equidistant: bool

    @property
    def highest_order(self) -> int:
        """The highest order that the positions show; anything above it appears as a lower one."""
        return self.count // 2 if self.equidistant else (self.count - 1) // 2

    def columns(self, angles_rad: FloatArray) -> FloatArray:
        """Values of (cos rθ, sin rθ) at the angles, for r = 0 … highest_order.

        At half the number of positions the points see one phase only: that order's first column is
        cos r(θ − offset), its second one zero, as the second one of order 0 is.

        Returns
        -------
        ndarray, shape (orders, angles, 2)
        """
        orders = np.arange(self.highest_order + 1)
        phase = orders[:, None] * angles_rad
        columns = np.stack([np.cos(phase), np.sin(phase)], axis=-1)
        if self.halved(self.highest_order):
            columns[-1, :, 0] = np.cos(phase[-1] - self.highest_order * self.offset_rad)
            columns[-1, :, 1] = 0.0
        return columns

    def halved(self, order: int) -> bool:
        """Whether the grid shows only one phase of this order (it is half the number of positions)."""
        return self.equidistant and order > 0 and 2 * order == self.count


def find_grid(angles_rad: npt.ArrayLike) -> CircumferentialGrid:
    """Find the coarsest equidistant grid that holds all angles, at least half of it occupied.

    Parameters
    ----------
    angles_rad : array_like, shape (angles,)
        Angles in any order, repeated or modulo 2π (rad).

    Raises
    ------
    IdentificationError
        With fewer than three different angles.
    """
    angles = _different(angles_rad)
    if angles.size < _LEAST_ANGLES:
        raise IdentificationError(
            f"{angles.size} different angles round the circumference cannot show an order: "
            f"measure at {_LEAST_ANGLES} or more"
        )
    for count in range(angles.size, 2 * angles.size + 1):
        # the mean phase of exp(iNθ) has modulus 1 exactly when all angles lie on one grid of N positions
        phase = np.mean(np.exp(1j * count * angles))
        if abs(phase) >= _LEAST_COHERENCE:
            return CircumferentialGrid(count, float(np.angle(phase)) / count, True)
    return CircumferentialGrid(angles.size, 0.0, False)


def _different(angles_rad: npt.ArrayLike) -> npt.NDArray[Any]:
    angles = np.sort(np.mod(np.asarray(angles_rad, dtype=float).ravel(), 2 * np.pi))
    gaps = np.diff(angles, append=angles[:1] + 2 * np.pi)
    return angles[gaps > SAME_ANGLE_RAD]


def different_angles(angles_rad: npt.ArrayLike) -> int:
    """Number of different angles, modulo 2π; repeated points count once."""
    return int(_different(angles_rad).size)
