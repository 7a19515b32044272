"""Measured points sorted into surfaces, planes and angles."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from statorhom.errors import IdentificationError
from statorhom.modes.gap_clusters import angle_clusters, gap_clusters
from statorhom.modes.stray_angles import stray_angles
from statorhom.recordings.dof import Dof

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int_]

# What nobody marks apart: radii closer than a yoke is thick, planes and angles closer than a sensor is wide.
_SAME_RADIUS = 1e-2  # of the largest radius
_SAME_PLANE = 5e-3  # of the length or the radius, whichever is larger
_SAME_ANGLE_RAD = 5e-3


@dataclass(frozen=True)
class Cell:
    """All sensors at one place of a surface.

    Attributes
    ----------
    plane, column : int
        Where it lies on the surface.
    rows : ndarray of int, shape (sensors,)
        Numbers of the degrees of freedom.
    directions : ndarray, shape (sensors, 3)
        Their (radial, tangential, axial) directions.
    """

    plane: int
    column: int
    rows: IntArray
    directions: FloatArray


@dataclass(frozen=True)
class Surface:
    """A cylinder of points.

    Attributes
    ----------
    radius_m : float
        Mean radius (m).
    z_m : ndarray, shape (planes,)
        Axial positions, ascending (m).
    angles_rad : ndarray, shape (angles,)
        Angles of the columns, ascending (rad).
    cells : tuple of Cell
        The occupied places; the others were not measured.
    """

    radius_m: float
    z_m: FloatArray
    angles_rad: FloatArray
    cells: tuple[Cell, ...]


@dataclass(frozen=True)
class PointLayout:
    """Where the degrees of freedom of a measurement lie.

    Attributes
    ----------
    count : int
        Number of degrees of freedom.
    surfaces : tuple of Surface
        From the largest radius to the smallest.
    remarks : tuple of str
        What was left out, and why.
    """

    count: int
    surfaces: tuple[Surface, ...]
    remarks: tuple[str, ...]


def lay_out(dofs: Sequence[Dof]) -> PointLayout:
    """Sort degrees of freedom into cylinders, planes and angles, with tolerances found from the points.

    Parameters
    ----------
    dofs : sequence of Dof
        In the order of the shapes' values.

    Raises
    ------
    IdentificationError
        When no point lies off the axis with a known position and direction.
    """
    placed = np.array([d.position is not None and d.direction is not None for d in dofs], dtype=bool)
    positions = np.array([d.position if ok else (0.0, 0.0, 0.0) for d, ok in zip(dofs, placed, strict=True)])
    radii = np.hypot(positions[:, 0], positions[:, 1]) if len(dofs) else np.zeros(0)
    largest = float(radii.max(initial=0.0))
    used = placed & (radii > _SAME_RADIUS * largest)
    if not used.any():
        raise IdentificationError(
            "no measured point lies off the machine axis with a position and a direction: shapes need both"
        )
    remarks = _counted(int((~placed).sum()), "without a position or direction")
    remarks += _counted(int((placed & ~used).sum()), "on the machine axis, where there is no angle")
    directions = np.array([_cylindrical(d) if ok else (0.0,) * 3 for d, ok in zip(dofs, used, strict=True)])
    rows = np.flatnonzero(used)
    numbers = gap_clusters(radii[rows], _SAME_RADIUS * largest)
    surfaces = []
    for number in range(int(numbers.max()), -1, -1):
        surface, said = _surface(rows[numbers == number], positions, directions)
        surfaces.append(surface)
        remarks += said
    return PointLayout(len(dofs), tuple(surfaces), tuple(remarks))


def _cylindrical(dof: Dof) -> tuple[float, float, float]:
    direction = dof.cylindrical_direction
    assert direction is not None
    return direction


def _counted(count: int, where: str) -> list[str]:
    if not count:
        return []
    return [f"{count} measured {'direction' if count == 1 else 'directions'} {where}: left out"]


def _surface(rows: IntArray, positions: FloatArray, directions: FloatArray) -> tuple[Surface, list[str]]:
    x, y, z = positions[rows].T
    radius = float(np.hypot(x, y).mean())
    plane = gap_clusters(z, _SAME_PLANE * max(float(np.ptp(z)), radius))
    column, angles = angle_clusters(np.arctan2(y, x), _SAME_ANGLE_RAD)
    stray = stray_angles(angles)
    kept = ~stray[column]
    remarks = _counted(
        int((~kept).sum()),
        f"beside the equidistant grid of the other points (radius {1000 * radius:.4g} mm)",
    )
    planes = np.unique(plane[kept])
    z_m = np.array([z[kept & (plane == p)].mean() for p in planes])
    renumbered = np.cumsum(~stray) - 1
    cells = []
    for i, p in enumerate(planes):
        for c in np.unique(column[kept & (plane == p)]):
            own = rows[(plane == p) & (column == c)]
            cells.append(Cell(i, int(renumbered[c]), own, directions[own]))
    return Surface(radius, z_m, angles[~stray], tuple(cells)), remarks
