"""MAC of measured shapes and the simulated modes that they were paired with."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.spatial import KDTree

from statorhom.mesh.mirror_mesh import MirrorMesh
from statorhom.modes.mac import mac, subspace_mac
from statorhom.modes.measured_shape import MeasuredShape
from statorhom.modes.point_shape import PointShape, TestShapes
from statorhom.results.full_surface import full_surface
from statorhom.results.schema import ModeResult
from statorhom.results.shape_file import ModeShape, ShapeFile

OFF = 0.05  # of a body's largest size: sensors farther from its surface are in another frame
FEWEST = 6  # sensors: the shapes of fewer look alike


def with_mac(
    modes: Sequence[ModeResult], simulated: ShapeFile, measured: Mapping[str, TestShapes]
) -> tuple[ModeResult, ...]:
    """Results with their MAC where both shapes are known.

    Parameters
    ----------
    modes : results of free tests; `label` is the row of the test's table.
    simulated : shapes that `ModeResult.shape` counts.
    measured : test → shapes by row.
    """
    found = []
    for mode in modes:
        shapes = measured.get(mode.test or "", ())
        if mode.shape is None or mode.label is None or not shapes:
            found.append(mode)
            continue
        shape = shapes[int(mode.label) - 1]
        simulated_mode = simulated.modes[mode.shape]
        if isinstance(shape, PointShape):
            value = _mac_of_points(simulated, simulated_mode, shape)
        else:
            value = _mac(simulated, simulated_mode, shape)
        found.append(mode.model_copy(update={"mac": value}))
    return tuple(found)


def _mac_of_points(simulated: ShapeFile, mode: ModeShape, shape: PointShape) -> float | None:
    """MAC at the sensors of a plate, a beam or a wing; None where they are too few or not on it."""
    if not isinstance(simulated.mesh, MirrorMesh) or len(np.unique(shape.positions_m, axis=0)) < FEWEST:
        return None
    surface = full_surface(simulated.mesh)
    distance, nearest = KDTree(surface.nodes).query(shape.positions_m)
    if distance.max() > OFF * np.ptp(surface.nodes, axis=0).max():
        return None
    moved = simulated.displacement(surface, mode)[nearest]
    along = np.sum(moved * shape.directions, axis=1)
    return mac(along, shape.values) if np.any(along) else None


def _mac(simulated: ShapeFile, mode: ModeShape, shape: MeasuredShape) -> float | None:
    """Part of the measured radial motion that is of the mode; a doublet's mode may be turned as it likes."""
    if mode.order is None or mode.harmonic is None or isinstance(simulated.mesh, MirrorMesh):
        return None
    along = CubicSpline(simulated.planes_m, mode.spectrum[:, mode.order].real)(shape.z_m)
    # planes beside the core lie on a frame, which is another surface
    along[(shape.z_m < 0) | (shape.z_m > simulated.mesh.length)] = np.nan
    angle = mode.order * shape.angles_rad
    waves = [np.cos(angle), np.sin(angle)] if mode.parity == "pair" else [np.cos(angle)]
    columns = np.column_stack([np.outer(along, wave).ravel() for wave in waves])
    return subspace_mac(columns, shape.radial.ravel())
