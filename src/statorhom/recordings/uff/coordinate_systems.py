"""Dataset 2420: coordinate systems in which directions are measured."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from statorhom.recordings.dof import Vector
from statorhom.recordings.uff.records import Place, fields, reals
from statorhom.recordings.uff.units import Units

CARTESIAN, CYLINDRICAL = 0, 1
_LINES_OF_PART, _LINES_PER_SYSTEM = 2, 6
_LABEL = ((10, int), (10, int), (10, int))
_ORTHOGONAL = 1e-4
# of the radius that a point needs for its radial direction to be known (m)
_ON_THE_AXIS = 1e-9


@dataclass(frozen=True)
class CoordinateSystem:
    """A Cartesian or cylindrical system.

    Attributes
    ----------
    kind : int
        0 Cartesian, 1 cylindrical; no direction can be resolved in others (2, spherical).
    axes : array, shape (3, 3)
        Its x, y, z axes as rows, in global coordinates. The format multiplies a row [x y z 1] by the four
        rows of its matrix, so the first three are the axes and the fourth is the origin.
    origin : array, shape (3,)
        m.
    """

    kind: int
    axes: np.ndarray
    origin: np.ndarray

    def direction(self, position: Vector, axis: int) -> Vector | None:
        """Global components of the unit vector of an axis (0, 1, 2) at a point; None where it has none."""
        if self.kind not in (CARTESIAN, CYLINDRICAL):
            return None
        local = np.eye(3)[axis]
        if self.kind == CYLINDRICAL and axis < 2:
            x, y, _ = self.axes @ (np.array(position) - self.origin)
            radius = float(np.hypot(x, y))
            if radius < _ON_THE_AXIS:
                return None
            local = np.array([x, y, 0.0] if axis == 0 else [-y, x, 0.0]) / radius
        vector = local @ self.axes
        return (float(vector[0]), float(vector[1]), float(vector[2]))


GLOBAL = CoordinateSystem(CARTESIAN, np.eye(3), np.zeros(3))


def read_systems(place: Place, lines: list[str], units: Units) -> dict[int, CoordinateSystem]:
    """Read dataset 2420.

    Parameters
    ----------
    place : Place
    lines : list of str
        Its records.
    units : Units

    Returns
    -------
    dict of int to CoordinateSystem
        By label.

    Raises
    ------
    RecordingError
    """
    systems: dict[int, CoordinateSystem] = {}
    for start in range(_LINES_OF_PART, len(lines), _LINES_PER_SYSTEM):
        batch = lines[start : start + _LINES_PER_SYSTEM]
        # the line with the dataset's type is the first one
        line = start + 2
        if len(batch) < _LINES_PER_SYSTEM:
            raise place.error(
                line, "ends within a coordinate system", "the file is truncated; export it again"
            )
        label, kind, _ = fields(place, line, batch[0], _LABEL)
        matrix = np.array([reals(place, line + 2 + row, text, 3) for row, text in enumerate(batch[2:])])
        axes = matrix[:3]
        if not np.allclose(axes @ axes.T, np.eye(3), atol=_ORTHOGONAL):
            raise place.error(line, f"axes of coordinate system {label} are not orthogonal unit vectors")
        systems[label] = CoordinateSystem(kind, axes, matrix[3] / units.length)
    return systems
