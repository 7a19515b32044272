"""MAC of measured shapes and the simulated modes that they were paired with."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from scipy.interpolate import CubicSpline

from statorhom.mesh.mirror_mesh import MirrorMesh
from statorhom.modes.mac import subspace_mac
from statorhom.modes.measured_shape import MeasuredShape
from statorhom.results.schema import ModeResult
from statorhom.results.shape_file import ModeShape, ShapeFile


def with_mac(
    modes: Sequence[ModeResult], simulated: ShapeFile, measured: Mapping[str, tuple[MeasuredShape, ...]]
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
        pair = simulated.modes[mode.shape], shapes[int(mode.label) - 1]
        found.append(mode.model_copy(update={"mac": _mac(simulated, *pair)}))
    return tuple(found)


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
