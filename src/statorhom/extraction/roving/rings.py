"""Points of a body around an axis, by measuring plane."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from statorhom.recordings.dof import Dof

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int_]

_SAME_M = 1e-6
_FEWEST_PLANES, _FEWEST_POINTS = 2, 6
_RADIAL = 0.9  # least radial part of a sensor's direction


@dataclass(frozen=True, eq=False)
class Rings:
    """Radial sensors in several planes across an axis.

    Attributes
    ----------
    heights_m : array, shape (planes,)
        Ascending.
    radius_m : float
    plane : int array, shape (points,)
        Number of every point's plane.
    angles_rad : array, shape (points,)
    signs : array, shape (points,)
        1 for sensors that measure outwards, −1 for the others.
    """

    heights_m: FloatArray
    radius_m: float
    plane: IntArray
    angles_rad: FloatArray
    signs: FloatArray

    @property
    def members(self) -> list[IntArray]:
        """Numbers of the points of every plane."""
        return [np.flatnonzero(self.plane == z) for z in range(len(self.heights_m))]

    @property
    def highest_order(self) -> int:
        """Waves around the circumference that the angles of every plane tell apart."""
        around = [len(np.unique(self.angles_rad[one].round(6))) for one in self.members]
        return (min(around) - 1) // 2


def rings(points: Sequence[Dof]) -> Rings | None:
    """The rings that all points lie on; None where they lie otherwise."""
    directions = [point.cylindrical_direction for point in points]
    places = [point.position for point in points]
    if None in directions or None in places:
        return None
    outward = np.array([one[0] for one in directions if one is not None])
    x, y, z = np.array([one for one in places if one is not None]).T
    heights, plane = np.unique((z / _SAME_M).round(), return_inverse=True)
    if len(heights) < _FEWEST_PLANES or np.bincount(plane).min() < _FEWEST_POINTS:
        return None
    if np.abs(outward).min() < _RADIAL:
        return None
    return Rings(heights * _SAME_M, float(np.hypot(x, y).mean()), plane, np.arctan2(y, x), np.sign(outward))
