"""Names of the supported stator's modes, whose shapes mix circumferential orders."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from statorhom.model.affine import AffineModel, Materials
from statorhom.model.free_modes import total_mass
from statorhom.model.stator_mode import VISIBLE
from statorhom.model.supported_shapes import SurfaceModes
from statorhom.model.surface_grid import SamplingGrid, sampling_grid
from statorhom.modes.naming import motion_kind, name_shape


@dataclass(frozen=True)
class SupportedMode:
    """A named mode of the supported stator; a simulated mode for the pairing.

    Parameters
    ----------
    frequency_hz : undamped natural frequency.
    order, axial : the name (r, n) of the largest component of the radial motion; None where there is none.
    kind : "radial", "torsion", "axial" or "winding".
    visibility : twice the mean square radial motion times the stator's mass over the modal mass, cut at 1.
    multiplicity : 1: a support splits the doublets.
    share : the order's part of the radial mean square; for other kinds the part of the motion not radial.
    column : number of the mode in `SurfaceModes`.
    """

    frequency_hz: float
    order: int | None
    axial: int | None
    kind: str
    visibility: float
    multiplicity: int
    share: float
    column: int


def name_supported(
    modes: SurfaceModes, model: AffineModel, materials: Materials, grid: SamplingGrid | None = None
) -> tuple[SupportedMode, ...]:
    """Name all modes by the motion of the outer surface.

    Parameters
    ----------
    modes : of the supported stator.
    model, materials : that they were solved with.
    grid : where the surface's motion is sampled (default: `sampling_grid` of the model's mesh).
    """
    if len(modes) == 0:
        return ()
    grid = sampling_grid(model.mesh) if grid is None else grid
    shape = (len(grid.planes), len(grid.angles), 3, len(modes))
    motion = modes.motion(grid.points).reshape(shape)
    visibility = 2 * total_mass(model, materials) * np.mean(motion[:, :, 0] ** 2, axis=(0, 1))
    return tuple(
        _named(motion[..., i], grid, i, float(modes.frequencies_hz[i]), float(min(1.0, visibility[i])))
        for i in range(len(modes))
    )


def _named(
    motion: np.ndarray, grid: SamplingGrid, column: int, frequency_hz: float, visibility: float
) -> SupportedMode:
    """Name of the motion (planes, angles, 3) of one mode."""
    radial, tangential, axial = np.moveaxis(motion, -1, 0)
    if visibility <= VISIBLE and motion_kind(radial, tangential, axial)[0] == "radial":
        # as of the free stator: what the core's back does not show happens inside
        return SupportedMode(frequency_hz, None, None, "winding", visibility, 1, 1.0, column)
    name = name_shape(radial, grid.angles, grid.planes, tangential=tangential, axial_motion=axial)
    return SupportedMode(frequency_hz, name.order, name.axial, name.kind, visibility, 1, name.share, column)
