"""Supported tests of a stage: what the identified materials predict of them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from statorhom.identify.comparison.mode_results import measured_alone
from statorhom.identify.comparison.simulated_shapes import ShapeGrid, name_and_spectrum, shape_grid
from statorhom.identify.fits.stage_run import StageRun
from statorhom.identify.processes.workers import Tick, Workers
from statorhom.identify.residuals.model_error import DEFAULT_RELATIVE_SD
from statorhom.identify.residuals.stage_problem import EXPECTED, GATE, PAIRING_SD
from statorhom.identify.stages.stage_setup import TestModes
from statorhom.model.affine import stator_model
from statorhom.model.supported_modes import solve_supported
from statorhom.model.supported_shapes import SupportedModes
from statorhom.model.supports import support_on
from statorhom.modes.pairing import Pair, pair
from statorhom.modes.supported_names import SupportedMode, name_supported
from statorhom.results.full_surface import full_surface
from statorhom.results.schema import ModeResult
from statorhom.results.shape_file import ModeShape
from statorhom.study.modal_table import MeasuredMode
from statorhom.study.supports import SupportKeys

BAND = 1.1
MARGIN = 1.5  # of the free modes behind a prediction: errors of 0.1 %, where supports are off by many percent
# Supports are known worse than materials: a predicted mode may lie this far off and still be the measured one.
SUPPORTED_SD = 2 * PAIRING_SD


@dataclass(frozen=True)
class _Mapper:
    """The workers as a plain map over harmonics."""

    workers: Workers

    def __call__(self, function: Any, orders: Iterable[int]) -> Iterator[Any]:
        return iter(self.workers.map(_apply, [(function, order) for order in orders]))


def _apply(task: tuple[Any, int], tick: Tick) -> Any:
    function, order = task
    result = function(order)
    tick()
    return result


def supported_results(
    run: StageRun, supports: dict[str, SupportKeys], first_shape: int, workers: Workers
) -> tuple[tuple[ModeResult, ...], tuple[ModeShape, ...]]:
    """Predicted modes of the stage's supported tests beside the measured ones, and their shapes.

    Parameters
    ----------
    run : the fitted stage.
    supports : test → its support.
    first_shape : row of the shape file that the first shape will have.
    workers : processes for the harmonics.

    Raises
    ------
    SupportError
        If a support does not fit the stator.
    """
    results: list[ModeResult] = []
    shapes: list[ModeShape] = []
    for test in run.setup.tests:
        if test.name in supports:
            prediction = _Prediction.of(run, test, supports[test.name], workers)
            new_results, new_shapes = prediction.compared(first_shape + len(shapes))
            results += new_results
            shapes += new_shapes
    return tuple(results), tuple(shapes)


@dataclass(frozen=True)
class _Prediction:
    """The modes of one supported test at the identified materials."""

    run: StageRun
    test: TestModes
    modes: SupportedModes
    names: tuple[SupportedMode, ...]
    grid: ShapeGrid

    @classmethod
    def of(cls, run: StageRun, test: TestModes, keys: SupportKeys, workers: Workers) -> _Prediction:
        model = stator_model(run.model)
        mesh = model.mesh
        top = BAND * max(mode.frequency_hz for mode in test.modes)
        support = support_on(mesh, keys)
        materials = run.effects.materials(run.materials)
        modes = solve_supported(model, materials, support, top, margin=MARGIN, mapper=_Mapper(workers))
        return cls(run, test, modes, name_supported(modes, model, materials), shape_grid(mesh))

    def compared(self, first_shape: int) -> tuple[list[ModeResult], list[ModeShape]]:
        """Results of the test, and the shapes of the modes that were paired."""
        measured = self.test.modes
        found = pair(measured, self.names, SUPPORTED_SD, gate=GATE)
        partner = {p.measured: p for p in found.pairs}
        results: list[ModeResult] = []
        shapes: list[ModeShape] = []
        for i, mode in enumerate(measured):
            if i not in partner:
                results.append(measured_alone(self.test.name, mode))
                continue
            results.append(self._paired(mode, partner[i], first_shape + len(shapes)))
            shapes.append(self._shape(self.names[partner[i].simulated]))
        top = max(mode.frequency_hz for mode in measured)
        for number in found.unpaired_simulated:
            alone = self.names[number]
            if alone.visibility >= EXPECTED and alone.frequency_hz <= top:
                results.append(self._alone(alone))
        return results, shapes

    def _factor(self, name: SupportedMode) -> float:
        """Mesh factor of the free modes of the same order: the mesh bends the supported shapes alike."""
        return self.run.error.factor((name.order, name.axial or 0, 0)) if name.order is not None else 1.0

    def _paired(self, measured: MeasuredMode, found: Pair, shape: int) -> ModeResult:
        name = self.names[found.simulated]
        simulated = name.frequency_hz * self._factor(name)
        return ModeResult(
            test=self.test.name,
            label=measured.mode,
            measured_hz=measured.frequency_hz,
            measured_sd_hz=measured.frequency_sd_hz or DEFAULT_RELATIVE_SD * measured.frequency_hz,
            model_sd_hz=self._model_sd(name) * simulated,
            simulated_hz=simulated,
            error_percent=100 * (simulated / measured.frequency_hz - 1),
            order=name.order,
            axial=name.axial,
            kind=name.kind,
            share=name.share,
            role="held_out",
            doubt=found.doubt,
            mesh_percent=100 * (self._factor(name) - 1),
            measured_loss_factor=measured.loss_factor,
            shape=shape,
        )

    def _model_sd(self, name: SupportedMode) -> float:
        shared = self.run.error.shared((name.order or 0, name.axial or 0, 0))
        return float(np.hypot(shared, self.run.fit.problem.discrepancy))

    def _alone(self, name: SupportedMode) -> ModeResult:
        return ModeResult(
            test=self.test.name,
            simulated_hz=name.frequency_hz * self._factor(name),
            order=name.order,
            axial=name.axial,
            kind=name.kind,
            share=name.share,
            mesh_percent=100 * (self._factor(name) - 1),
            role="unmatched",
        )

    def _shape(self, name: SupportedMode) -> ModeShape:
        grid, mesh = self.grid, stator_model(self.run.model).mesh
        motion = self.modes.motion(grid.points)[..., name.column]
        found, spectrum = name_and_spectrum(grid, motion.reshape(len(grid.planes), len(grid.angles), 3))
        whole = self.modes.full_shape(mesh, name.column)
        return ModeShape(
            frequency_hz=name.frequency_hz,
            displacement=whole[full_surface(mesh).full_node],
            harmonic=None,
            parity="",
            order=name.order,
            axial=name.axial,
            kind=name.kind,
            share=found.share,
            spectrum=spectrum,
        )
