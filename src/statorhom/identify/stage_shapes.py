"""The shape file of a stage: the modes that the report draws."""

from __future__ import annotations

from statorhom.identify.mode_results import simulated_modes
from statorhom.identify.simulated_shapes import mode_shape, shape_grid
from statorhom.identify.stage_run import StageRun
from statorhom.results.shape_file import ModeShape, ShapeFile

MOST = 16  # pictures of a stage


def free_shapes(run: StageRun) -> tuple[ShapeFile, dict[int, int]]:
    """Shapes of the visible modes of the band, and for each simulated mode its row.

    Returns
    -------
    shapes : ShapeFile
    rows : number of the simulated mode (as `simulated_modes` counts) → row.
    """
    grid = shape_grid(run.model.mesh)
    modes: list[ModeShape] = []
    rows: dict[int, int] = {}
    for number, mode in enumerate(simulated_modes(run)):
        if mode.visibility >= 1.0 and len(modes) < MOST:
            rows[number] = len(modes)
            modes.append(mode_shape(grid, run.solution, mode.mode))
    return ShapeFile(run.model.mesh, grid.planes, tuple(modes)), rows
