"""All steps of a study, one after the other; what is done already and still holds is not done again."""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from threadpoolctl import threadpool_limits

from statorhom.geometry.tested_object import ObjectGeometry, object_geometry
from statorhom.identify.comparison.measured_mac import with_mac
from statorhom.identify.comparison.stage_shapes import free_shapes
from statorhom.identify.comparison.supported_results import supported_results
from statorhom.identify.fits.priors import Carried
from statorhom.identify.fits.stage_checks import check_design, check_materials
from statorhom.identify.fits.stage_run import run_stage
from statorhom.identify.processes.announce import Announce, silent
from statorhom.identify.processes.workers import Workers
from statorhom.identify.residuals.effect_shifts import effect_shifts
from statorhom.identify.results.described import described
from statorhom.identify.results.stage_remarks import recording_remarks
from statorhom.identify.results.stage_result import mass_only, stage_result
from statorhom.identify.stages.settings import Settings
from statorhom.identify.stages.stage_setup import StageSetup, analytic_values, check_fit, stage_setup
from statorhom.materials.density import RegionDensity
from statorhom.model.basis_store import BasisStore
from statorhom.modes.point_shape import TestShapes
from statorhom.results.files import check_folder, earlier_stages, write_results
from statorhom.results.schema import RegionResult, Results, StageResult
from statorhom.results.shape_file import write_shape_file
from statorhom.study.digest import stage_digest
from statorhom.study.study import StudyFiles
from statorhom.study.supports import SupportKeys

FORMAT = 1  # of the program's results: a change of method makes earlier ones stale


@dataclass(frozen=True)
class ChainState:
    """What the steps so far hand on."""

    carried: Carried = field(default_factory=Carried)
    regions: Mapping[str, RegionResult] = field(default_factory=dict)
    mass_kg: float = 0.0
    stages: tuple[StageResult, ...] = ()

    def after(self, result: StageResult) -> ChainState:
        """State after one more step."""
        known = self.carried if result.carried is None else Carried.from_state(result.carried)
        return ChainState(known, result.regions, result.mass_kg, (*self.stages, result))


@dataclass(frozen=True)
class Chain:
    """A study with its geometry, ready to be identified into a folder.

    Parameters
    ----------
    files : the study.
    geometry : of its machine or coupon.
    folder : where results go.
    settings : of the run.
    bases : folder of the reduced bases, which machines may share.
    measured : shapes of the tests that have recordings, by row of their tables.
    """

    files: StudyFiles
    geometry: ObjectGeometry
    folder: Path
    settings: Settings
    bases: Path
    measured: Mapping[str, TestShapes] = field(default_factory=dict)

    def check(self) -> None:
        """Refuse, before any work, what no step can be identified from.

        Raises
        ------
        StatorhomError
            If a file, a mass or a test does not allow it, or earlier results are damaged or of another study.
        """
        self._setups(len(self.files.study.stages) - 1)
        self._earlier()

    def finished(self) -> Results | None:
        """What the folder holds already if that is all steps as the inputs stand now, else None.

        Raises
        ------
        ResultsError
            If earlier results are damaged or of another study.
        """
        earlier = self._earlier()
        stages = [earlier.get(self._digest(i)) for i in range(len(self.files.study.stages))]
        done = tuple(stage for stage in stages if stage is not None)
        return self._results(done) if len(done) == len(stages) else None

    def run(self, last: int | None = None, announce: Announce = silent) -> Results:
        """Identify all steps up to one (default: all) and write results.json after each.

        Raises
        ------
        StatorhomError
            If a file, a mass or a test does not allow it; steps that are done stay written.
        """
        stages = self.files.study.stages
        last = len(stages) - 1 if last is None else last
        setups = self._setups(last)
        check_folder(self.folder)
        earlier = self._earlier()
        state = ChainState()
        with threadpool_limits(limits=1, user_api="blas"), Workers(self.settings.jobs) as workers:
            for setup in setups:
                digest = self._digest(setup.index)
                done = earlier.get(digest)
                result = done if done is not None else self._step(setup, state, digest, workers, announce)
                state = state.after(result)
                kept = () if done is None else self._kept(earlier, setup.index)
                write_results(self._results((*state.stages, *kept)), self.folder)
        return self._results(state.stages)

    def _setups(self, last: int) -> list[StageSetup]:
        """All steps up to one; every fault of the input shows before the first is identified."""
        setups = [stage_setup(self.files, self.geometry, i) for i in range(last + 1)]
        for setup in setups:
            check_fit(self.files, setup)
            check_materials(self.files, setup)
            check_design(self.files, setup)
            effect_shifts(self.files, setup)
        return setups

    def _step(
        self, setup: StageSetup, state: ChainState, digest: str, workers: Workers, announce: Announce
    ) -> StageResult:
        began = time.perf_counter()
        if not setup.tests:
            result = mass_only(setup, state.mass_kg, state.regions)
        else:
            result = self._fitted(setup, state, workers, announce)
        return result.model_copy(
            update={
                "digest": digest,
                "seconds": round(time.perf_counter() - began, 1),
                "warnings": (*result.warnings, *recording_remarks(self.files, setup.keys)),
            }
        )

    def _fitted(
        self, setup: StageSetup, state: ChainState, workers: Workers, announce: Announce
    ) -> StageResult:
        carried = state.carried
        for region in setup.new:
            carried = carried.without(region)
        analytic = analytic_values(
            self.files, setup, _earlier_densities(self.files, self.geometry, setup.index)
        )
        store, effects = BasisStore(self.bases), effect_shifts(self.files, setup)
        run = run_stage(setup, carried, analytic, self.settings, workers, announce, store, effects)
        shapes, rows = free_shapes(run)
        result = stage_result(run, state.mass_kg, state.regions, rows)
        progress = announce("supported tests", 1)
        predicted, more = supported_results(run, self._supports(setup), len(shapes.modes), workers)
        progress(1)
        name = f"shapes/{setup.index + 1}-{setup.keys.name}.npz"
        write_shape_file(self.folder / name, replace(shapes, modes=(*shapes.modes, *more)))
        free = with_mac(result.modes, shapes, self.measured)
        return result.model_copy(update={"shapes": name, "modes": (*free, *predicted)})

    def _supports(self, setup: StageSetup) -> dict[str, SupportKeys]:
        """Support of every supported test of a stage."""
        found = {test.name: self.files.study.support(test.support) for test in setup.tests}
        return {name: support for name, support in found.items() if support is not None}

    def _digest(self, index: int) -> str:
        extra = {**self.settings.digest_parts(), "format": FORMAT, "program": program_version()}
        return stage_digest(self.files, index, extra)

    def _earlier(self) -> dict[str, StageResult]:
        """Results of a run that was interrupted or of an earlier step, by digest.

        Raises
        ------
        ResultsError
            If they are damaged or of another study: they are the user's to delete.
        """
        stages = earlier_stages(self.folder, self.files.study.name)
        return {stage.digest: stage for stage in stages if stage.digest and self._has_shapes(stage)}

    def _has_shapes(self, stage: StageResult) -> bool:
        return stage.shapes is None or (self.folder / stage.shapes).exists()

    def _kept(self, earlier: Mapping[str, StageResult], index: int) -> tuple[StageResult, ...]:
        """Later steps that still hold stay in the file while an earlier one is only looked up."""
        kept: list[StageResult] = []
        for later in range(index + 1, len(self.files.study.stages)):
            stage = earlier.get(self._digest(later))
            if stage is None:
                break
            kept.append(stage)
        return tuple(kept)

    def _results(self, stages: tuple[StageResult, ...]) -> Results:
        return Results(
            schema=1,
            study=self.files.study.name,
            seed=self.settings.seed,
            program=program_version(),
            geometry=described(self.files.drawing, self.geometry),
            stages=stages,
        )


def chain(
    files: StudyFiles,
    folder: Path,
    settings: Settings,
    bases: Path | None = None,
    measured: Mapping[str, TestShapes] | None = None,
) -> Chain:
    """A chain of a study's steps.

    Its reduced bases stay in `folder` unless `bases` names another place; `measured` are the shapes of the
    tests that have recordings.

    Raises
    ------
    GeometryError
        If the machine is impossible.
    """
    geometry = object_geometry(files.drawing, files.geometry_path)
    return Chain(files, geometry, folder, settings, bases or folder / "bases", measured or {})


def program_version() -> str:
    """Name and version of the program."""
    try:
        return f"statorhom {version('statorhom')}"
    except PackageNotFoundError:
        return "statorhom"


def _earlier_densities(files: StudyFiles, geometry: ObjectGeometry, index: int) -> dict[str, RegionDensity]:
    found: dict[str, RegionDensity] = {}
    for earlier in range(index):
        found |= stage_setup(files, geometry, earlier).densities
    return found
