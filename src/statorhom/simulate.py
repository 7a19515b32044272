"""Simulated modes of every step, as modes.csv and shape files."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
from threadpoolctl import threadpool_limits

from statorhom.errors import InputFileError
from statorhom.geometry.tested_object import object_geometry
from statorhom.identify.comparison.stage_shapes import shape_file
from statorhom.identify.fits.priors import Carried, stage_space
from statorhom.identify.fits.stage_checks import check_materials
from statorhom.identify.fits.stage_run import PREDICTED_MESHES, PREDICTED_MODES
from statorhom.identify.processes.workers import Workers
from statorhom.identify.residuals.effect_shifts import effect_shifts
from statorhom.identify.residuals.model_error import ModelError, model_error
from statorhom.identify.residuals.refinement import Band, MeshSeries
from statorhom.identify.residuals.stage_problem import CorrectedMode, corrected
from statorhom.identify.stages.bands import LEAST_VISIBLE, highest_hz
from statorhom.identify.stages.block_names import block_names
from statorhom.identify.stages.settings import Settings
from statorhom.identify.stages.stage_materials import StageMaterials
from statorhom.identify.stages.stage_setup import StageSetup, TestModes, stage_setup
from statorhom.materials.hooke import Hooke
from statorhom.mesh.hex_mesh import PartMesh
from statorhom.mesh.mirror_mesh import MirrorMesh
from statorhom.model.affine import AffineModel, Material, Materials, stator_model
from statorhom.model.convergence import ModeKey
from statorhom.model.free_modes import FreeModes, solve_free
from statorhom.model.supported_modes import solve_supported
from statorhom.model.supports import support_on
from statorhom.modes.mode_protocols import LabelledMode
from statorhom.modes.supported_names import SupportedMode, name_supported
from statorhom.results.files import check_folder, earlier_stages
from statorhom.results.schema import RegionResult
from statorhom.results.shape_file import write_shape_file
from statorhom.study.atomic import write_text
from statorhom.study.study import StudyFiles, load_study
from statorhom.study.supports import SupportKeys

MARGIN = 1.15
DEFAULT_BAND_HZ = 6000.0  # of a stage whose tests have no table to tell
DEFAULT_SUPPORTED_HZ = 3000.0
PICTURES = 24
COLUMNS = ("mode", "frequency_hz", "order", "axial", "stage", "test")
LEAST_SPLIT = 1e-6  # of ln f: below, one line stands for both


def simulate_study(path: Path, stage: str | None, out: Path | None) -> tuple[Path, pd.DataFrame]:
    """Simulate the modes of the steps with tests and write modes.csv and shapes into a folder.

    Parameters
    ----------
    path : the study file.
    stage : only this step; None for all.
    out : the folder; None for the default one. Materials identified there are used, else typical ones.

    Returns
    -------
    file, table : modes.csv and its contents.

    Raises
    ------
    StatorhomError
        If the study's files or its geometry do not allow it.
    """
    files = load_study(path)
    folder = files.path.parent / f"{files.study.name}-results" if out is None else out
    geometry = object_geometry(files.drawing, files.geometry_path)
    identified = _identified(folder, files.study.name)
    _check_stage(files, stage)
    setups = [stage_setup(files, geometry, index) for index in range(len(files.study.stages))]
    check_folder(folder)
    rows: list[dict[str, object]] = []
    known = Carried()
    with threadpool_limits(limits=1, user_api="blas"):
        for setup in setups:
            if setup.step is None or not setup.tests:
                continue
            check_materials(files, setup)
            materials, known = _materials(setup, known, identified.get(setup.keys.name, {}))
            if stage in (None, setup.keys.name):
                rows += _simulate(files, setup, materials, folder)
    named = any("name" in row for row in rows)  # of plates, beams and wings
    table = pd.DataFrame(rows, columns=[*COLUMNS, "name"] if named else [*COLUMNS])
    table = table.astype({"order": "Int64", "axial": "Int64"})
    target = folder / "modes.csv"
    write_text(target, table.to_csv(index=False))
    return target, table


def _check_stage(files: StudyFiles, name: str | None) -> None:
    tests = {stage.name: stage.tests for stage in files.study.stages}
    if name is not None and name not in tests:
        raise InputFileError(f"{files.path}: there is no stage {name!r}; choose one of {', '.join(tests)}")
    if not any(tests.values() if name is None else tests[name or ""]):
        what = "no stage has" if name is None else f"the stage {name!r} has no"
        raise InputFileError(f"{files.path}: {what} tests, so nothing says what to simulate; add a test")


def _identified(folder: Path, study: str) -> dict[str, Mapping[str, RegionResult]]:
    return {stage.name: stage.regions for stage in earlier_stages(folder, study)}


def _materials(
    setup: StageSetup, known: Carried, identified: Mapping[str, RegionResult]
) -> tuple[Materials, Carried]:
    """Identified materials where all are known, else the middle of the typical ranges."""
    for region in setup.new:
        known = known.without(region)
    space = stage_space(setup.keys, setup.materials, setup.new, setup.densities, known, {})
    typical = setup.materials.of(space.values(space.start))
    found = _from_results(setup.materials, identified)
    following = Carried(tuple(p for p in space.parameters if p.name != "mesh"), space.ties)
    return (typical if found is None else found), following


def _from_results(materials: StageMaterials, identified: Mapping[str, RegionResult]) -> Materials | None:
    found: dict[str, Material] = {}
    for region in materials.regions:
        result = identified.get(region.source)
        if result is None or result.hooke_pa is None or result.density_kg_m3 is None:
            return None
        found[region.region] = region.weighted(
            Material(Hooke(np.array(result.hooke_pa)), result.density_kg_m3)
        )
    return found


def _simulate(
    files: StudyFiles, setup: StageSetup, materials: Materials, folder: Path
) -> list[dict[str, object]]:
    """Rows of one stage: its free tests share one solution, every supported one has its own."""
    assert setup.step is not None
    series = MeshSeries(setup.step, Settings().density, Settings().refinements[:PREDICTED_MESHES])
    top = MARGIN * highest_hz(setup.free_modes) if setup.free_modes else DEFAULT_BAND_HZ
    solution = solve_free(series.coarsest, materials, top, jobs=os.cpu_count() or 1)
    mesh = series.coarsest.mesh
    names = block_names(mesh, solution) if isinstance(mesh, MirrorMesh) else {}
    _write_shapes(setup, series.coarsest, solution, names, folder)
    error = _mesh_error(series, materials, top, solution)
    effects = effect_shifts(files, setup)
    orders = sorted({solution.harmonics[m.problem].order for m in solution.modes})
    error = replace(error, effects=effects.at(series.coarsest, materials, top, orders))
    free = sorted(_lines(corrected(solution.modes, error), error), key=lambda mode: mode.frequency_hz)
    rows = []
    for test in setup.tests:
        support = files.study.support(test.support)
        modes: Sequence[LabelledMode] = free
        if support is not None:
            modes = _supported(
                stator_model(series.coarsest), effects.materials(materials), support, test, error
            )
        rows += [_row(setup, test.name, i, mode, names) for i, mode in enumerate(modes, start=1)]
    return rows


def _lines(modes: Sequence[CorrectedMode], error: ModelError) -> list[CorrectedMode]:
    """Both lines of every doublet that a declared effect splits, else the mode as it is."""
    found = []
    for mode in modes:
        response = None if mode.key is None else error.effects.get(mode.key)
        half = 0.0 if response is None else abs(response.split) / 4
        for side in (-half, half) if half > LEAST_SPLIT else (0.0,):
            found.append(replace(mode, frequency_hz=mode.frequency_hz * float(np.exp(side))))
    return found


def _supported(
    model: AffineModel, materials: Materials, keys: SupportKeys, test: TestModes, error: ModelError
) -> list[SupportedMode]:
    """Modes on a support, with the mesh factors of the free modes of the same names."""
    top = MARGIN * highest_hz(test.modes) if test.modes else DEFAULT_SUPPORTED_HZ
    modes = solve_supported(model, materials, support_on(model.mesh, keys), top)
    return [
        replace(mode, frequency_hz=mode.frequency_hz * error.factor((mode.order, mode.axial or 0, 0)))
        if mode.order is not None
        else mode
        for mode in name_supported(modes, model, materials)
    ]


def _mesh_error(series: MeshSeries, materials: Materials, top_hz: float, solution: FreeModes) -> ModelError:
    """Mesh factors as a fit would have them.

    Modes that hardly move the surface are not worth the finer mesh and take the factor of the others.
    """
    harmonics = {solution.harmonics[m.problem].order for m in solution.modes if m.visibility > LEAST_VISIBLE}
    band = Band(top_hz, PREDICTED_MESHES, PREDICTED_MODES)
    study = series.study(materials, dict.fromkeys(sorted(harmonics), band), Workers())
    return model_error(study, {c.key: c.frequency_hz[0] for c in study})


def _row(
    setup: StageSetup, test: str, number: int, mode: LabelledMode, names: Mapping[ModeKey, str]
) -> dict[str, object]:
    row: dict[str, object] = {
        "mode": number,
        "frequency_hz": round(mode.frequency_hz, 2),
        "order": mode.order,
        "axial": mode.axial,
        "stage": setup.keys.name,
        "test": test,
    }
    key = mode.key if isinstance(mode, CorrectedMode) else None
    return row | {"name": names.get(key, "") if key is not None else ""} if names else row


def _write_shapes(
    setup: StageSetup,
    model: AffineModel[PartMesh],
    solution: FreeModes,
    names: Mapping[ModeKey, str],
    folder: Path,
) -> None:
    visible = [mode for mode in solution.modes if mode.family is not None][:PICTURES]
    name = f"simulated-{setup.index + 1}-{setup.keys.name}.npz"
    write_shape_file(folder / "shapes" / name, shape_file(model, solution, visible, names))
