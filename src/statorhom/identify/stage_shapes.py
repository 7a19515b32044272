"""The shape file of a stage: the modes that the report draws."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from statorhom.identify.mode_results import simulated_modes
from statorhom.identify.simulated_shapes import block_shape, mode_shape, shape_grid
from statorhom.identify.stage_run import StageRun
from statorhom.mesh.hex_mesh import PartMesh
from statorhom.mesh.mirror_mesh import MirrorMesh
from statorhom.model.affine import AffineModel, stator_model
from statorhom.model.free_modes import FreeModes
from statorhom.model.mirror_names import mirror_kind
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
    return shape_file(run.model, run.solution, modes), rows


def shape_file(model: AffineModel[PartMesh], solution: FreeModes, modes: Sequence[StatorMode]) -> ShapeFile:
    """Shapes of some modes of a solution."""
    if isinstance(model.mesh, MirrorMesh):
        mesh = model.mesh
        shapes = tuple(block_shape(solution, mode, mirror_kind(mesh, mode.parities or 0)) for mode in modes)
        return ShapeFile(mesh, np.zeros(0), shapes)
    stator = stator_model(model).mesh
    grid = shape_grid(stator)
    return ShapeFile(stator, grid.planes, tuple(mode_shape(grid, solution, mode) for mode in modes))
