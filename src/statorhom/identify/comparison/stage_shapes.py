"""The shape file of a stage: the modes that the report draws."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from statorhom.identify.comparison.mode_results import simulated_modes
from statorhom.identify.comparison.simulated_shapes import block_shape, mode_shape, shape_grid
from statorhom.identify.fits.stage_run import StageRun
from statorhom.mesh.hex_mesh import PartMesh
from statorhom.mesh.mirror_mesh import MirrorMesh
from statorhom.model.affine import AffineModel, stator_model
from statorhom.model.convergence import ModeKey, mode_keys
from statorhom.model.free_modes import FreeModes
from statorhom.model.stator_mode import StatorMode
from statorhom.results.shape_file import ShapeFile

MOST = 16  # pictures of a stage


def free_shapes(run: StageRun) -> tuple[ShapeFile, dict[int, int]]:
    """Shapes of the visible modes of the band, and for each simulated mode its row.

    Returns
    -------
    shapes : ShapeFile
    rows : number of the simulated mode (as `simulated_modes` counts) → row.
    """
    modes: list[StatorMode] = []
    rows: dict[int, int] = {}
    for number, mode in enumerate(simulated_modes(run)):
        if mode.visibility >= 1.0 and len(modes) < MOST:
            rows[number] = len(modes)
            modes.append(mode.mode)
    return shape_file(run.model, run.solution, modes, run.block_names), rows


def shape_file(
    model: AffineModel[PartMesh],
    solution: FreeModes,
    modes: Sequence[StatorMode],
    names: Mapping[ModeKey, str],
) -> ShapeFile:
    """Shapes of some modes of a solution.

    Parameters
    ----------
    model, solution : the modes' own.
    modes : to keep.
    names : of a block's modes, see `block_names`.
    """
    if isinstance(model.mesh, MirrorMesh):
        known = {id(mode): names.get(key, "") for key, mode in mode_keys(solution.modes).items()}
        shapes = tuple(block_shape(solution, mode, known.get(id(mode), "")) for mode in modes)
        return ShapeFile(model.mesh, np.zeros(0), shapes)
    stator = stator_model(model).mesh
    grid = shape_grid(stator)
    return ShapeFile(stator, grid.planes, tuple(mode_shape(grid, solution, mode) for mode in modes))
