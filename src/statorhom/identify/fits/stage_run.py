"""Fit one step from its setup: meshes, basis, search, polish and the full solution at the result."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

from statorhom.errors import IdentificationError
from statorhom.identify.bases.basis_check import BasisCheck, check_basis, together
from statorhom.identify.bases.fit_bases import FitBases
from statorhom.identify.bases.stage_basis import LOOK
from statorhom.identify.fits.priors import Carried, common_space, stage_space
from statorhom.identify.fits.stage_fit import StageFit, fit_from, search, search_space
from statorhom.identify.inference.polish import Optimum, polish
from statorhom.identify.parameters.parameter_space import ParameterSpace
from statorhom.identify.processes.announce import Announce
from statorhom.identify.processes.workers import Workers
from statorhom.identify.residuals.effect_shifts import NO_EFFECTS, EffectShifts
from statorhom.identify.residuals.model_error import ModelError, model_error
from statorhom.identify.residuals.refinement import Band, MeshSeries
from statorhom.identify.residuals.stage_problem import StageProblem
from statorhom.identify.stages.bands import highest_hz, mode_names, named_spaces
from statorhom.identify.stages.block_names import block_names
from statorhom.identify.stages.settings import Settings
from statorhom.identify.stages.stage_setup import StageSetup
from statorhom.identify.surface.cube import Cube
from statorhom.identify.surface.experiments import Experiments, FullModel
from statorhom.identify.surface.part_model import part_model
from statorhom.identify.surface.search import SurfaceSearch, search_surface
from statorhom.materials.transversely_isotropic import TransverselyIsotropic
from statorhom.mesh.hex_mesh import PartMesh
from statorhom.mesh.mirror_mesh import MirrorMesh
from statorhom.model.affine import AffineModel, Materials
from statorhom.model.basis_store import BasisStore
from statorhom.model.broken.named_response import Response
from statorhom.model.convergence import ModeConvergence, ModeKey
from statorhom.model.free_modes import FreeModes
from statorhom.study.response_surface import SurfaceKeys

ModeName = tuple[int, int | None]  # order and node planes
BAND_MARGIN = 1.15
# of the convergence study, for orders that no fitted mode has: meshes, and modes of each harmonic problem
PREDICTED_MESHES, PREDICTED_MODES = 2, 12


@dataclass(frozen=True)
class StageRun:
    """A fitted stage with the full model at its optimum.

    Parameters
    ----------
    setup : what it started from.
    fit : the fit.
    model : the fitting mesh.
    materials : of the optimum.
    solution : free modes of the fitting mesh at the optimum.
    error : mesh factors of the full model's modes.
    plain : the optimum that the fitting mesh alone would give, without mesh factors.
    basis : the reduced model verified on the full one at every optimum of the posterior.
    basis_error : largest certified relative frequency error of the reduced model where it was trained.
    effects : that the study declares.
    surface : the search, where response surfaces did it.
    at_tests : free modes of the fitting mesh at the values of material tests, where the study names some.
    """

    setup: StageSetup
    fit: StageFit
    model: AffineModel[PartMesh]
    materials: Materials
    solution: FreeModes
    error: ModelError
    plain: Optimum
    basis: BasisCheck
    basis_error: float
    effects: EffectShifts = NO_EFFECTS
    surface: SurfaceSearch | None = None
    at_tests: FreeModes | None = None

    @cached_property
    def block_names(self) -> Mapping[ModeKey, str]:
        """Names of the simulated modes of a plate, a beam or a wing; none of others."""
        return block_names(self.model.mesh, self.solution) if isinstance(self.model.mesh, MirrorMesh) else {}


def run_stage(
    setup: StageSetup,
    carried: Carried,
    analytic: dict[str, TransverselyIsotropic | None],
    settings: Settings,
    workers: Workers,
    announce: Announce,
    store: BasisStore | None = None,
    effects: EffectShifts = NO_EFFECTS,
) -> StageRun:
    """Identify the constants of a step.

    Parameters
    ----------
    setup : the stage; it has fitted modes.
    carried : constants of earlier steps, those that this step identifies anew left out.
    analytic : homogenized start values.
    settings, workers : of the run.
    announce : told what begins.
    store : where reduced bases are kept between runs.
    effects : that the study declares.

    Raises
    ------
    IdentificationError
        If no mode of a free test is left to fit.
    """
    if not setup.fitted or setup.step is None:
        raise IdentificationError(
            f"stage {setup.keys.name!r}: no mode is left to fit; give it a free test with modes that are not held out"
        )
    series = MeshSeries(setup.step, settings.density, settings.refinements)
    model = series.coarsest
    known = (setup.keys, setup.materials, setup.new, setup.densities, carried, analytic)
    space = stage_space(*known)
    searched = search_space(space)
    typical = setup.materials.of(searched.values(searched.start))
    top = highest_hz(setup.fitted)
    names = mode_names(model, typical, setup.fitted)
    problems = named_spaces(model.mesh, names)
    spread = common_space(*known) if settings.shared_bases else space
    bases = FitBases(model, problems, top, workers, announce, store, settings.shared_bases)
    predicted = mode_names(model, typical, setup.free_modes, BAND_MARGIN)
    bands = _study_bands(setup, names, predicted, len(series.models))
    band = BAND_MARGIN * highest_hz(setup.free_modes)

    def shifts(materials: Materials) -> dict[ModeKey, Response]:
        return effects.at(model, materials, band, sorted(bands))

    def refine(materials: Materials) -> tuple[ModeConvergence, ...]:
        return series.study(materials, bands, workers)

    error = ModelError(effects=shifts(typical))
    keys, acting = setup.keys.identify, shifts if effects.actions else None
    surface: SurfaceSearch | None = None
    if keys.method == "response_surface":
        # all modes of a block are bending or torsion that a sensor sees; a stator has many that none does
        measured = len(setup.fitted) if isinstance(model.mesh, MirrorMesh) else None
        full = part_model(model, typical, LOOK * top, sorted({order for order, _ in names}), measured)
        surface = _by_surface(setup, searched, full, error, settings.seed, workers, announce)
        starts = surface.starts(space)
        reduced = bases.around(surface.problem_over(space), starts)
        problem = StageProblem(space, setup.materials, reduced, setup.fitted, error)
        spent = surface.evaluations
    else:
        reduced = bases.over_prior(spread, setup.materials, typical)
        problem = StageProblem(space, setup.materials, reduced, setup.fitted, error)
        progress, spent = announce("search", keys.evaluations), keys.evaluations
        starts = search(problem, keys, seed=settings.seed, workers=workers, progress=progress)
    fit = fit_from(problem, starts, spent, refine, bases.around, seed=settings.seed, effects=acting)
    run = _finished(setup, fit, series, sorted(bands), workers, effects)
    return replace(run, surface=surface)


def _by_surface(
    setup: StageSetup,
    searched: ParameterSpace,
    full: FullModel,
    error: ModelError,
    seed: int,
    workers: Workers,
    announce: Announce,
) -> SurfaceSearch:
    keys = setup.keys.identify
    surface = keys.response_surface or SurfaceKeys()
    progress = announce("full solves of the design", surface.most_points)
    experiments = Experiments(Cube(searched), setup.materials, full, workers, progress)
    return search_surface(
        experiments, setup.fitted, surface, error=error, evaluations=keys.evaluations, seed=seed
    )


def _study_bands(
    setup: StageSetup, fitted: set[ModeName], predicted: set[ModeName], meshes: int
) -> dict[int, Band]:
    """Order → band of the convergence study: all meshes where a mode is fitted, few where it is predicted."""
    band = BAND_MARGIN * highest_hz(setup.free_modes)
    bands = {order: Band(band, PREDICTED_MESHES, PREDICTED_MODES) for order, _ in predicted}
    top = BAND_MARGIN * highest_hz(setup.fitted)
    return bands | {order: Band(top, meshes, None) for order, _ in fitted}


def _finished(
    setup: StageSetup,
    fit: StageFit,
    series: MeshSeries,
    orders: list[int],
    workers: Workers,
    effects: EffectShifts,
) -> StageRun:
    best = fit.posterior.best.x
    materials = fit.problem.stage_materials(best)
    band = BAND_MARGIN * highest_hz(setup.free_modes)
    solution = series.solution(materials, band, orders, workers)
    same = {c.key: c.frequency_hz[0] for c in fit.convergence}
    shifts = fit.problem.error.effects
    plain = polish(replace(fit.problem, error=ModelError(effects=shifts)), best)
    # what is reported beside the best optimum is held against the full model as well
    rivals = [
        check_basis(
            fit.problem.solve(part.optimum.x),
            series.solution(fit.problem.stage_materials(part.optimum.x), band, orders, workers),
        )
        for part in fit.posterior.components[1:]
    ]
    return StageRun(
        setup=setup,
        fit=fit,
        model=series.coarsest,
        materials=materials,
        solution=solution,
        error=replace(model_error(fit.convergence, same), effects=shifts),
        plain=plain,
        basis=together([check_basis(fit.problem.solve(best), solution), *rivals]),
        basis_error=fit.problem.solver.error,
        effects=effects,
        at_tests=_at_tests(setup, fit, series, band, orders, workers),
    )


def _at_tests(
    setup: StageSetup, fit: StageFit, series: MeshSeries, band: float, orders: list[int], workers: Workers
) -> FreeModes | None:
    """Modes with the tests' mean values in the place of the identified ones."""
    space = fit.problem.space
    tested: dict[str, list[float]] = {}
    for test in setup.keys.material_tests:
        name = f"{test.region}.{test.constant}"
        led = {n: tie.names[0] for tie in space.ties for n in tie.names}
        tested.setdefault(led.get(name, name), []).append(test.value)
    if not tested:
        return None
    values = space.values(fit.posterior.best.x) | {name: sum(v) / len(v) for name, v in tested.items()}
    for tie in space.ties:
        if tie.names[0] in tested:
            values |= dict.fromkeys(tie.names, values[tie.names[0]])
    # stiffer samples have their modes higher up
    stiffer = max(1.0, *(values[n] / space.values(fit.posterior.best.x)[n] for n in tested))
    return series.solution(setup.materials.of(values), band * stiffer**0.5, orders, workers)
