"""Measured and simulated modes of a stage's free tests, side by side."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

from statorhom.identify.fits.stage_run import StageRun
from statorhom.identify.residuals.model_error import DEFAULT_RELATIVE_SD
from statorhom.identify.residuals.stage_problem import (
    EXPECTED,
    MESH,
    CorrectedMode,
    corrected,
    doublet_lines,
    pair_modes,
)
from statorhom.identify.stages.stage_setup import TestModes
from statorhom.mesh.mirror_mesh import MirrorMesh
from statorhom.results.schema import ModeResult
from statorhom.study.modal_table import MeasuredMode
from statorhom.study.study_file import FREE


def simulated_modes(run: StageRun) -> list[CorrectedMode]:
    """Modes of the full model at the optimum, with the mesh factors and the shared shift."""
    return corrected(run.solution.modes, run.error, shared_shift(run))


def shared_shift(run: StageRun) -> float:
    """The shared model error at the optimum, in its standard deviations."""
    return run.fit.problem.space.values(run.fit.posterior.best.x).get(MESH, 0.0)


def free_mode_results(run: StageRun, shapes: Mapping[int, int]) -> tuple[ModeResult, ...]:
    """Measured and simulated modes of the stage's free tests."""
    simulated = simulated_modes(run)
    results: list[ModeResult] = []
    for test in run.setup.tests:
        if test.support == FREE:
            results += _test_results(run, test, simulated, shapes)
    return tuple(results)


def _test_results(
    run: StageRun, test: TestModes, simulated: Sequence[CorrectedMode], shapes: Mapping[int, int]
) -> list[ModeResult]:
    measured = test.modes
    pairing = pair_modes(measured, simulated, with_doubt=True)
    partner = {p.measured: p for p in pairing.pairs}
    keys = [simulated[partner[i].simulated].key if i in partner else None for i in range(len(measured))]
    partners = {mode.key: mode for mode in simulated if mode.key is not None}
    lines = doublet_lines(measured, keys, partners, run.error)
    results = []
    for i, mode in enumerate(measured):
        role = "fitted" if mode in test.fitted else "held_out"
        if i not in partner:
            results.append(measured_alone(test.name, mode))
            continue
        number = partner[i].simulated
        results.append(
            _paired(
                run,
                test.name,
                mode,
                _on_line(simulated[number], lines[i]),
                role,
                partner[i].doubt,
                shapes.get(number),
            )
        )
    top = max(m.frequency_hz for m in measured)
    taken = {p.simulated for p in pairing.pairs}
    for number, alone in enumerate(simulated):
        if number not in taken and alone.mode.visibility >= EXPECTED and alone.frequency_hz <= top:
            results.append(_simulated_alone(run, test.name, alone, shapes.get(number)))
    return results


def _on_line(mode: CorrectedMode, line: float) -> CorrectedMode:
    return replace(mode, frequency_hz=mode.frequency_hz * math.exp(line)) if line else mode


def _paired(
    run: StageRun,
    test: str,
    measured: MeasuredMode,
    simulated: CorrectedMode,
    role: str,
    doubt: float,
    shape: int | None,
) -> ModeResult:
    problem, key = run.fit.problem, simulated.key
    own = run.error.own(key) if key is not None else 0.0
    shared = run.error.shared(key) if key is not None else 0.0
    model_sd = math.sqrt(own**2 + shared**2 + problem.discrepancy**2)
    return ModeResult(
        test=test,
        label=measured.mode,
        measured_hz=measured.frequency_hz,
        measured_sd_hz=measured.frequency_sd_hz or DEFAULT_RELATIVE_SD * measured.frequency_hz,
        model_sd_hz=model_sd * simulated.frequency_hz,
        simulated_hz=simulated.frequency_hz,
        error_percent=100 * (simulated.frequency_hz / measured.frequency_hz - 1),
        order=simulated.order,
        axial=simulated.axial,
        kind=_kind(run, simulated),
        role=role,  # type: ignore[arg-type]
        doubt=doubt,
        mesh_percent=None if key is None else 100 * (run.error.factor(key) - 1),
        measured_loss_factor=measured.loss_factor,
        shape=shape,
    )


def measured_alone(test: str, mode: MeasuredMode) -> ModeResult:
    """A measured mode that no simulated one explains."""
    return ModeResult(
        test=test,
        label=mode.mode,
        measured_hz=mode.frequency_hz,
        measured_sd_hz=mode.frequency_sd_hz or DEFAULT_RELATIVE_SD * mode.frequency_hz,
        order=mode.order,
        axial=mode.axial,
        measured_loss_factor=mode.loss_factor,
        role="unmatched",
    )


def _simulated_alone(run: StageRun, test: str, mode: CorrectedMode, shape: int | None) -> ModeResult:
    return ModeResult(
        test=test,
        simulated_hz=mode.frequency_hz,
        order=mode.order,
        axial=mode.axial,
        kind=_kind(run, mode),
        mesh_percent=None if mode.key is None else 100 * (run.error.factor(mode.key) - 1),
        role="unmatched",
        shape=shape,
    )


def _kind(run: StageRun, simulated: CorrectedMode) -> str:
    if isinstance(run.model.mesh, MirrorMesh):
        return run.block_names.get(simulated.key, "") if simulated.key is not None else ""
    return simulated.kind
