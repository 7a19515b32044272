"""The parameter space of a stage: new constants with typical priors, earlier ones with what was learnt."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, replace

import numpy as np

from statorhom.errors import IdentificationError
from statorhom.identify.inference.intervals import Posterior
from statorhom.identify.parameters.parameter_space import Parameter, ParameterSpace, Tie
from statorhom.identify.parameters.prior_block import PriorBlock
from statorhom.identify.residuals.stage_problem import MESH
from statorhom.identify.stages.stage_materials import DENSITY, StageMaterials
from statorhom.materials.density import RegionDensity
from statorhom.materials.transversely_isotropic import TransverselyIsotropic
from statorhom.materials.typical import prior_range
from statorhom.materials.typical_ranges import Z95
from statorhom.results.schema import CarriedParameter, CarriedState
from statorhom.study.regions import COUPON
from statorhom.study.stages import StageKeys


@dataclass(frozen=True)
class Carried:
    """Constants of earlier steps with their joint posterior, for the steps that follow."""

    parameters: tuple[Parameter, ...] = ()
    ties: tuple[Tie, ...] = ()
    block: PriorBlock | None = None

    def without(self, source: str) -> Carried:
        """Drop a region whose constants a step identifies anew."""
        prefix = f"{source}."
        parameters = tuple(p for p in self.parameters if not p.name.startswith(prefix))
        ties = tuple(t for t in self.ties if not t.names[0].startswith(prefix))
        block = self.block
        if block is not None:
            keep = [i for i, name in enumerate(block.names) if not name.startswith(prefix)]
            names = tuple(block.names[i] for i in keep)
            block = PriorBlock(names, block.mean[keep], block.covariance[keep][:, keep]) if names else None
        return Carried(parameters, ties, block)

    def state(self) -> CarriedState:
        """The same, as results.json keeps it."""
        block = self.block
        return CarriedState(
            parameters=tuple(CarriedParameter(**asdict(p)) for p in self.parameters),
            ties=tuple(tie.names for tie in self.ties),
            names=() if block is None else block.names,
            mean=() if block is None else tuple(block.mean.tolist()),
            covariance=() if block is None else tuple(tuple(row) for row in block.covariance.tolist()),
        )

    @classmethod
    def from_state(cls, state: CarriedState | None) -> Carried:
        """Back from results.json."""
        if state is None:
            return cls()
        return cls(
            tuple(Parameter(**p.model_dump()) for p in state.parameters),
            tuple(Tie(names) for names in state.ties),
            PriorBlock(state.names, np.array(state.mean), np.array(state.covariance))
            if state.names
            else None,
        )


def carried(posterior: Posterior) -> Carried:
    """What a fitted stage hands on: its constants without the shared model error, which the next mesh has anew."""
    space = posterior.space
    names = [name for name in space.coordinates if name != MESH]
    parameters = tuple(p for p in space.parameters if p.name != MESH)
    return Carried(parameters, space.ties, posterior.block(names))


def stage_space(
    stage: StageKeys,
    materials: StageMaterials,
    new: frozenset[str],
    densities: Mapping[str, RegionDensity],
    carried: Carried,
    analytic: Mapping[str, TransverselyIsotropic | None],
) -> ParameterSpace:
    """Constants of a stage.

    Parameters
    ----------
    stage : its study keys: fixed and tied constants, priors.
    materials : the regions and their symmetries.
    new : sources whose constants this stage identifies.
    densities : source → density with its standard deviation.
    carried : constants of earlier steps.
    analytic : source → homogenized start value, where the geometry file allows one.
    """
    parameters = list(carried.parameters)
    ties = list(carried.ties)
    for source, symmetry in materials.sources.items():
        if source not in new:
            continue
        parameters += [
            _constant(stage, source, symmetry, c, analytic.get(source)) for c in materials.constants[source]
        ]
        parameters.append(_density(source, densities[_weighed(source)]))
        ties += [_tie(source, group) for group in stage.identify.tied.get(source, ())]
    ties += _weighed_together(parameters, stage)
    parameters.append(Parameter(MESH, 0.0, -Z95, Z95, -4.0, 4.0, "linear"))
    blocks = () if carried.block is None else (carried.block,)
    return ParameterSpace(tuple(parameters), tuple(ties), blocks)


def common_space(
    stage: StageKeys,
    materials: StageMaterials,
    new: frozenset[str],
    densities: Mapping[str, RegionDensity],
    carried: Carried,
    analytic: Mapping[str, TransverselyIsotropic | None],
) -> ParameterSpace:
    """The space of `stage_space` without what is one machine's own: the results of its earlier steps, and what its
    weights tell of the winding.
    """
    of_geometry = {source: value for source, value in analytic.items() if source != "winding"}
    return stage_space(stage, materials, new, densities, replace(carried, block=None), of_geometry)


def _weighed(source: str) -> str:
    """The region whose density a source takes: an own overhang has the winding's."""
    return "winding" if source == "overhang" else source


def _constant(
    stage: StageKeys, source: str, symmetry: str, constant: str, analytic: TransverselyIsotropic | None
) -> Parameter:
    name = f"{source}.{constant}"
    fixed = stage.identify.fixed.get(source, {})
    if constant in fixed:
        return Parameter.constant(name, float(fixed[constant]))
    typical = prior_range(source, stage.kind, symmetry, constant, analytic)
    given = stage.identify.prior.get(source, {}).get(constant)
    if given is None:
        t = typical
        return Parameter(name, t.median, t.low90, t.high90, t.lower_bound, t.upper_bound, t.scale)
    if typical.scale == "log" and given.low <= 0:
        raise IdentificationError(
            f"stage {stage.name!r}: identify.prior.{source}.{constant}: low = {given.low:g} must be positive"
        )
    middle = (given.low * given.high) ** 0.5 if typical.scale == "log" else (given.low + given.high) / 2
    lower, upper = min(typical.lower_bound, given.low), max(typical.upper_bound, given.high)
    return Parameter(name, middle, given.low, given.high, lower, upper, typical.scale)


def _density(source: str, density: RegionDensity) -> Parameter:
    value, spread = density.density_kg_m3, Z95 * density.density_sd_kg_m3
    if spread == 0.0:
        return Parameter.constant(f"{source}.{DENSITY}", value)
    width = min(4 * spread, 0.9 * value)
    return Parameter(
        f"{source}.{DENSITY}", value, value - spread, value + spread, value - width, value + width, "linear"
    )


def _weighed_together(parameters: Sequence[Parameter], stage: StageKeys) -> list[Tie]:
    """Densities of a coupon's materials that one weight scales."""
    free = [p.name for p in parameters if p.name.endswith(DENSITY) and not p.fixed]
    return [Tie(tuple(free), "proportional")] if stage.kind == COUPON and len(free) > 1 else []


def _tie(source: str, group: tuple[str, ...]) -> Tie:
    return Tie(tuple(f"{source}.{constant}" for constant in group))
