"""Loss factors of a stage's regions and of its modes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from statorhom.identify.comparison.mode_results import simulated_modes
from statorhom.identify.fits.stage_run import StageRun
from statorhom.identify.residuals.stage_problem import CorrectedMode
from statorhom.identify.results.damping import LossFactors, LossPrior, fit_loss_factors
from statorhom.model.free_modes import strain_energy_shares
from statorhom.results.schema import ModeResult, RegionResult


def with_losses(
    run: StageRun, regions: Mapping[str, RegionResult], modes: Sequence[ModeResult]
) -> tuple[dict[str, RegionResult], tuple[ModeResult, ...]]:
    """Regions with their loss factors and free modes with the simulated ones.

    Only free tests count: what a support dissipates is none of the stator's.

    Parameters
    ----------
    run : the fitted stage.
    regions : after the step; earlier regions bring what was learnt of their loss factors.
    modes : results of the free tests.
    """
    simulated = {mode.frequency_hz: mode for mode in simulated_modes(run)}
    paired = [i for i, mode in enumerate(modes) if mode.simulated_hz in simulated]
    sources = list(run.setup.materials.sources)
    shares = [_shares(run, simulated[modes[i].simulated_hz or 0.0], sources) for i in paired]
    found = _fit(run, sources, shares, [modes[i].measured_loss_factor for i in paired], regions)
    updated = dict(regions)
    for source in sources:
        if source in run.setup.new:
            updated[source] = regions[source].model_copy(update={"loss_factor": found.regions[source]})
    if not any(interval is not None for interval in found.regions.values()):
        return updated, tuple(modes)
    predicted = {i: float(eta) for i, eta in zip(paired, found.predicted, strict=True)}
    return updated, tuple(
        mode.model_copy(update={"simulated_loss_factor": predicted[i]}) if i in predicted else mode
        for i, mode in enumerate(modes)
    )


def _fit(
    run: StageRun,
    sources: list[str],
    shares: list[list[float]],
    measured: list[float | None],
    regions: Mapping[str, RegionResult],
) -> LossFactors:
    priors = {}
    for source in sources:
        known = regions[source].loss_factor if source in regions else None
        if source not in run.setup.new and known is not None:
            priors[source] = LossPrior.of(known)
    return fit_loss_factors(sources, shares, measured, priors=priors)  # type: ignore[arg-type]


def _shares(run: StageRun, mode: CorrectedMode, sources: list[str]) -> list[float]:
    """Strain-energy share of each material: regions of one material count as one."""
    by_region = strain_energy_shares(run.model, run.materials, run.solution.shape(mode.mode))
    owner = {region.region: region.source for region in run.setup.materials.regions}
    return [sum(v for r, v in by_region.items() if owner[r] == source) for source in sources]
