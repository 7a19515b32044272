"""A measured shape on the grid of its points: planes along the axis times angles around it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from statorhom.errors import IdentificationError
from statorhom.modes.point_layout import PointLayout, Surface
from statorhom.modes.resolved_motion import ResolvedMotion, resolve_motion

FloatArray = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]

# Repeats contradict each other if chance makes such a difference this rarely in a whole shape …
_CONTRADICTION_LEVEL = 1e-3
# … and if it is no longer small beside the largest motion.
_LEAST_CONTRADICTION = 0.1


@dataclass(frozen=True)
class MeasuredShape:
    """Complex motion of a cylinder of points.

    Attributes
    ----------
    radius_m : float
        Radius of the points (m).
    z_m : ndarray, shape (planes,)
        Axial positions, ascending (m).
    angles_rad : ndarray, shape (angles,)
        Angles, ascending (rad).
    motion : ndarray of complex, shape (3, planes, angles)
        Radial, tangential and axial motion, in the unit of the values; NaN where not measured.
    sd : ndarray, shape (3, planes, angles)
        Standard deviation of the complex values (root mean square of |error|); NaN where unknown.
    remarks : tuple of str
        What was left out or contradicts itself.
    """

    radius_m: float
    z_m: FloatArray
    angles_rad: FloatArray
    motion: ComplexArray
    sd: FloatArray
    remarks: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        for array in (self.z_m, self.angles_rad, self.motion, self.sd):
            array.setflags(write=False)

    @property
    def radial(self) -> ComplexArray:
        """Radial motion, shape (planes, angles)."""
        return self.motion[0]

    @property
    def tangential(self) -> ComplexArray:
        """Tangential motion, shape (planes, angles)."""
        return self.motion[1]

    @property
    def axial(self) -> ComplexArray:
        """Axial motion, shape (planes, angles)."""
        return self.motion[2]


def measured_shapes(
    layout: PointLayout, values: npt.ArrayLike, sd: npt.ArrayLike | None = None
) -> tuple[MeasuredShape, ...]:
    """Put a shape's values on the grids of its surfaces, the largest radius first.

    Parameters
    ----------
    layout : PointLayout
        Where the values were measured.
    values : array_like of complex, shape (degrees of freedom,)
        The shape; NaN where it is missing.
    sd : array_like, shape (degrees of freedom,), optional
        Standard deviations of the complex values; equal weights without them.

    Raises
    ------
    IdentificationError
        When the numbers of values and degrees of freedom differ.
    """
    shape = np.asarray(values, dtype=complex)
    deviation = np.full(shape.shape, np.nan) if sd is None else np.asarray(sd, dtype=float)
    if shape.shape != (layout.count,) or deviation.shape != shape.shape:
        raise IdentificationError(
            f"a shape at {layout.count} degrees of freedom needs as many values and standard deviations, "
            f"got {shape.shape} and {deviation.shape}"
        )
    largest = float(np.nanmax(np.abs(shape), initial=0.0))
    found = [_on_surface(surface, shape, deviation, largest) for surface in layout.surfaces]
    return tuple(
        MeasuredShape(
            surface.radius_m, surface.z_m, surface.angles_rad, motion, spread, (*layout.remarks, *said)
        )
        for surface, (motion, spread, said) in zip(layout.surfaces, found, strict=True)
    )


def _on_surface(
    surface: Surface, values: ComplexArray, sd: FloatArray, largest: float
) -> tuple[ComplexArray, FloatArray, list[str]]:
    grid = (3, surface.z_m.size, surface.angles_rad.size)
    motion, spread = np.full(grid, np.nan, dtype=complex), np.full(grid, np.nan)
    cells = [
        (cell, resolve_motion(cell.directions, values[cell.rows], sd[cell.rows])) for cell in surface.cells
    ]
    unspanned, contradictory = 0, []
    for cell, found in cells:
        place = (slice(None), cell.plane, cell.column)
        motion[place], spread[place] = found.motion, found.sd
        unspanned += bool(np.isfinite(values[cell.rows]).any() and not np.isfinite(found.motion).any())
        if _contradicts(found, bool(np.isfinite(sd[cell.rows]).all()), largest, len(cells)):
            # the difference, not the noise, is then what the mean is uncertain by
            spread[place] = np.where(np.isfinite(found.motion), np.fmax(found.sd, found.misfit), np.nan)
            angle, z = surface.angles_rad[cell.column], surface.z_m[cell.plane]
            contradictory.append(f"{np.degrees(angle):.4g}° at z = {1000 * z:.4g} mm")
    remarks = []
    if unspanned:
        remarks.append(
            f"{unspanned} points have sensors that are neither radial, tangential nor axial and do not span "
            "such a direction: left out"
        )
    if contradictory:
        remarks.append(f"repeated measurements contradict each other at {', '.join(contradictory)}")
    return motion, spread, remarks


def _contradicts(found: ResolvedMotion, known_sd: bool, largest: float, places: int) -> bool:
    if found.misfit <= _LEAST_CONTRADICTION * largest:
        return False
    return not known_sd or found.p_repeats < _CONTRADICTION_LEVEL / places
