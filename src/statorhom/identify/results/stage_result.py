"""A fitted stage as results.json tells it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from statorhom.identify.comparison.mode_results import free_mode_results
from statorhom.identify.fits.priors import carried
from statorhom.identify.fits.stage_run import StageRun
from statorhom.identify.inference.intervals import Estimate
from statorhom.identify.residuals.sensitivity import sensitivity
from statorhom.identify.results.material_tests import material_test_results, tested_frequencies
from statorhom.identify.results.stage_losses import with_losses
from statorhom.identify.results.stage_remarks import assumptions, warnings
from statorhom.identify.results.surface_search import surface_summary
from statorhom.identify.stages.stage_materials import DENSITY
from statorhom.identify.stages.stage_setup import StageSetup
from statorhom.materials.density import RegionDensity
from statorhom.materials.plausibility import density_warning
from statorhom.mesh.mirror_mesh import MirrorMesh
from statorhom.model.convergence import ModeConvergence, ModeKey, mode_keys
from statorhom.results.schema import (
    Constant,
    Convergence,
    FitSummary,
    ModeResult,
    Optimum,
    RegionResult,
    Sensitivity,
    StageResult,
    SurfaceSummary,
)
from statorhom.study.response_surface import SurfaceKeys


def mass_only(setup: StageSetup, before_kg: float, earlier: Mapping[str, RegionResult]) -> StageResult:
    """Result of a stage without tests: its weight, and a density where the geometry gives a volume."""
    regions = dict(earlier)
    for region, density in setup.densities.items():
        if region in setup.new:
            regions[region] = _weighed(density)
    return _stage(setup, before_kg, regions)


def stage_result(
    run: StageRun, before_kg: float, earlier: Mapping[str, RegionResult], shapes: Mapping[int, int]
) -> StageResult:
    """Result of a fitted stage, the supported tests' modes left out.

    Parameters
    ----------
    run : the fit.
    before_kg : mass before the step.
    earlier : regions as the steps before left them.
    shapes : number of a simulated mode → row of the shape file.
    """
    regions = dict(earlier)
    estimates = run.fit.posterior.estimates()
    for source in run.setup.materials.sources:
        if source in run.setup.new:
            regions[source] = _fitted_region(run, source, estimates)
    regions, modes = with_losses(run, regions, free_mode_results(run, shapes))
    result = _stage(run.setup, before_kg, regions)
    return result.model_copy(
        update={
            "modes": modes,
            "material_tests": material_test_results(run.setup.keys.material_tests, regions),
            "tested_frequencies": tested_frequencies(run),
            "convergence": tuple(_convergence(run, c) for c in run.fit.convergence),
            "fit": _summary(run, modes),
            "sensitivity": _sensitivity(run),
            "carried": carried(run.fit.posterior).state(),
            "assumptions": assumptions(run),
            "warnings": (*result.warnings, *warnings(run, modes)),
        }
    )


def _fitted_region(run: StageRun, source: str, estimates: Mapping[str, Estimate]) -> RegionResult:
    symmetry = run.setup.materials.sources[source]
    density = run.setup.densities["winding" if source == "overhang" else source]
    matrix = run.materials[source].hooke.matrix
    engineering = {}
    for constant in run.setup.materials.constants[source]:
        e = estimates[f"{source}.{constant}"]
        engineering[constant] = Constant(
            value=e.value, ci90=(e.low90, e.high90), status=e.status, narrowed=e.spread_ratio
        )
    return _weighed(density).model_copy(
        update={
            "symmetry": symmetry,
            "hooke_pa": tuple(tuple(float(v) for v in row) for row in matrix),
            "engineering": engineering,
        }
    )


def _weighed(density: RegionDensity) -> RegionResult:
    return RegionResult(
        volume_m3=density.volume_m3,
        density_kg_m3=density.density_kg_m3,
        density_sd_kg_m3=density.density_sd_kg_m3,
    )


def _stage(setup: StageSetup, before_kg: float, regions: Mapping[str, RegionResult]) -> StageResult:
    keys = setup.keys
    doubts = (density_warning(d) for d in setup.densities.values() if d.stage == keys.name)
    return StageResult(
        name=keys.name,
        kind=keys.kind,
        mass_kg=keys.mass_kg,
        mass_sd_kg=keys.mass_sd_kg,
        added_mass_kg=keys.mass_kg - before_kg,
        regions=dict(regions),
        warnings=tuple(doubt.message for doubt in doubts if doubt is not None),
    )


def _convergence(run: StageRun, c: ModeConvergence) -> Convergence:
    block = isinstance(run.model.mesh, MirrorMesh)
    return Convergence(
        order=None if block else c.key[0],
        axial=None if block else c.key[1],
        kind=run.block_names.get(c.key, "") if block else None,
        dof=c.dof,
        frequency_hz=c.frequency_hz,
        extrapolated_hz=c.extrapolated_hz,
        sd_percent=100 * c.sd,
    )


def _sensitivity(run: StageRun) -> Sensitivity:
    """∂ ln f / ∂ ln p of the fitted modes; densities come from the scale and are left out."""
    problem, best = run.fit.problem, run.fit.posterior.best.x
    keys = [key for key in problem.pairing(problem.simulated(best)) if key is not None]
    found = sensitivity(problem.solve(best), problem.materials, problem.space.values(best), keys)
    used = [i for i, name in enumerate(found.constants) if not name.endswith(DENSITY)]
    return Sensitivity(
        constants=tuple(found.constants[i] for i in used),
        modes=_mode_names(run, keys) or found.modes,
        values=tuple(tuple(float(row[i]) for i in used) for row in found.values),
    )


def _mode_names(run: StageRun, keys: Sequence[ModeKey]) -> tuple[str, ...]:
    """Names of a block's modes: by the motion and the frequency; none of others."""
    if not isinstance(run.model.mesh, MirrorMesh):
        return ()
    solved = mode_keys(run.fit.problem.solve(run.fit.posterior.best.x).modes)
    return tuple(
        f"{run.block_names.get(key, '')} {solved[key].frequency_hz:.0f} Hz".strip()
        for key in keys
        if key in solved
    )


def _summary(run: StageRun, modes: Sequence[ModeResult]) -> FitSummary:
    fitted = [m.error_percent for m in modes if m.role == "fitted" and m.error_percent is not None]
    held = [m.error_percent for m in modes if m.role == "held_out" and m.error_percent is not None]
    posterior, space = run.fit.posterior, run.fit.problem.space
    new = [n for n in space.names if n.split(".")[0] in run.setup.new and not n.endswith(DENSITY)]
    plain = space.values(run.plain.x)
    return FitSummary(
        method=run.setup.keys.identify.method,
        evaluations=run.fit.evaluations,
        optima=tuple(
            Optimum(
                values={n: v for n, v in space.values(c.optimum.x).items() if n in new},
                cost=c.optimum.value,
                probability=float(weight),
            )
            for c, weight in zip(posterior.components, posterior.weights, strict=True)
        ),
        rms_percent=_rms(fitted) or 0.0,
        max_percent=max((abs(e) for e in fitted), default=0.0),
        held_out_rms_percent=_rms(held),
        reduced_basis_error_percent=_percent(run.basis_error),
        reduced_basis_certified_percent=_percent(run.basis.certified),
        reduced_basis_deviation_percent=100 * run.basis.deviation,
        unexplained_percent=100 * run.fit.problem.discrepancy,
        without_mesh_correction={n: plain[n] for n in new},
        surface=_surface(run, modes),
    )


def _surface(run: StageRun, modes: Sequence[ModeResult]) -> SurfaceSummary | None:
    keys = run.setup.keys.identify.response_surface or SurfaceKeys()
    return None if run.surface is None else surface_summary(run.surface, keys, modes)


def _percent(part: float) -> float | None:
    return 100 * part if np.isfinite(part) else None


def _rms(errors: Sequence[float]) -> float | None:
    return float(np.sqrt(np.mean(np.square(errors)))) if errors else None
