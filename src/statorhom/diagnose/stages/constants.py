"""All constants of a study's steps in one vector: materials shared along the chain, weights, mesh error, scatter.

Every coordinate measures the deviation from its prior median in prior standard deviations.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from statorhom.identify.fits.priors import Carried, stage_space
from statorhom.identify.parameters.parameter_space import Parameter
from statorhom.identify.residuals.stage_problem import MESH
from statorhom.identify.stages.stage_materials import DENSITY
from statorhom.identify.stages.stage_setup import StageSetup
from statorhom.materials.typical_ranges import Z95
from statorhom.study.study import StudyFiles
from statorhom.study.supports import LineSupport

FloatArray = npt.NDArray[np.float64]
# typical loss factors (5 %, 95 %): bare steel and what is joined to it; wires, dry or in resin
STEEL_LOSS, WINDING_LOSS = (5e-4, 2e-2), (2e-3, 1e-1)
LOSS_LIMITS = (1e-6, 2.0)
FIXED = 1e-9  # relative standard deviation of what the study prescribes


@dataclass(frozen=True)
class Constant:
    """One coordinate.

    Parameters
    ----------
    name : "stage:source.constant", "stage:mass_kg", "stage:mesh", "stage:loss source", "sinking test" or
        "scatter r re/im".
    median, sd : of the normal prior, of the logarithm where `log`.
    lower, upper : limits of the value.
    log : scale of the prior.
    """

    name: str
    median: float
    sd: float
    lower: float
    upper: float
    log: bool = False

    def value(self, internal: float) -> float:
        """In its own unit."""
        step = self.sd * internal
        value = self.median * math.exp(step) if self.log else self.median + step
        return min(max(value, self.lower), self.upper)

    @property
    def fixed(self) -> bool:
        """Whether the study prescribes it."""
        return not self.log and self.sd <= 2 * FIXED * (abs(self.median) or 1.0)

    @property
    def limits(self) -> tuple[float, float]:
        """Of the coordinate."""
        low, high = (
            (np.log(v / self.median) if self.log else v - self.median) / self.sd
            for v in (self.lower, self.upper)
        )
        return float(low), float(high)


@dataclass(frozen=True)
class Constants:
    """The coordinates of a study.

    Parameters
    ----------
    items : in the order of the vector.
    owners : per stage: constant as the stage's materials name it → name of the coordinate.
    losses : per stage: source of a region's material → name of its loss factor; empty where no damping was measured.
    """

    items: tuple[Constant, ...]
    owners: tuple[Mapping[str, str], ...]
    losses: tuple[Mapping[str, str], ...] = ()

    def __len__(self) -> int:
        return len(self.items)

    @cached_property
    def names(self) -> tuple[str, ...]:
        """Of the coordinates."""
        return tuple(c.name for c in self.items)

    def values(self, x: FloatArray) -> dict[str, float]:
        """Values by name."""
        return {c.name: c.value(u) for c, u in zip(self.items, x.tolist(), strict=True)}

    def stage_values(self, values: Mapping[str, float], stage: int) -> dict[str, float]:
        """Material constants of a stage, by the names that its materials use; densities left out."""
        return {own: values[name] for own, name in self.owners[stage].items()}

    @cached_property
    def limits(self) -> tuple[FloatArray, FloatArray]:
        """Lowest and highest coordinates."""
        pairs = np.array([c.limits for c in self.items])
        return pairs[:, 0], pairs[:, 1]


def new_constants(constants: Constants, stage: str) -> list[int]:
    """Places of a step's own material constants, those that are not fixed."""
    prefix = f"{stage}:"
    return [
        i
        for i, c in enumerate(constants.items)
        if c.name.startswith(prefix) and "." in c.name and not c.fixed
    ]


def study_constants(
    setups: Sequence[StageSetup],
    orders: Sequence[int],
    scatter_sd: float,
    *,
    with_losses: bool = False,
    on_lines: Sequence[str] = (),
) -> Constants:
    """Coordinates of all steps.

    Parameters
    ----------
    setups : the steps.
    orders : circumferential orders whose doublets manufacturing scatter splits.
    scatter_sd : of the real and of the imaginary part of their relative split.
    with_losses : whether loss factors were measured.
    on_lines : names of the tests that lines hold (`held_by_lines`): how far these sink in is one unknown for all
        modes of a test.
    """
    items: list[Constant] = []
    owners: list[dict[str, str]] = []
    known: dict[str, str] = {}
    damped: dict[str, str] = {}
    losses: list[Mapping[str, str]] = []
    for setup in setups:
        stage = setup.keys.name
        items.append(_weight(stage, setup.keys.mass_kg, setup.keys.mass_sd_kg))
        if setup.tests:
            space = stage_space(setup.keys, setup.materials, setup.new, setup.densities, Carried(), {})
            leaders = {n: tie.names[0] for tie in space.ties for n in tie.names[1:]}
            for parameter in space.parameters:
                if parameter.name == MESH or parameter.name.endswith(DENSITY) or parameter.name in leaders:
                    continue
                name = f"{stage}:{parameter.name}"
                known = {k: v for k, v in known.items() if k != parameter.name} | {parameter.name: name}
                items.append(_constant(name, parameter))
            known |= {n: known[first] for n, first in leaders.items()}
            items.append(Constant(f"{stage}:mesh", 0.0, 1.0, -5.0, 5.0))
        used = {n for region in setup.materials.regions for n in region.names}
        owners.append({n: known[n] for n in used if n in known})
        sources = (
            {region.source for region in setup.materials.regions} if with_losses and setup.tests else set()
        )
        for source in sorted(sources):
            if source in setup.new or source not in damped:
                damped = {**damped, source: f"{stage}:loss {source}"}
                items.append(_loss(damped[source], source))
        losses.append({source: damped[source] for source in sources})
    items += [Constant(sinking_of(test), 0.0, 1.0, -5.0, 5.0) for test in on_lines]
    items += [
        Constant(f"scatter {r} {part}", 0.0, scatter_sd, -1.0, 1.0) for r in orders for part in ("re", "im")
    ]
    return Constants(tuple(items), tuple(owners), tuple(losses))


def held_by_lines(files: StudyFiles, setups: Sequence[StageSetup]) -> list[str]:
    """Names of the steps' tests that lines hold."""
    tests = [test for setup in setups for test in setup.tests]
    return [t.name for t in tests if isinstance(files.study.support(t.support), LineSupport)]


def scatter_of(values: Mapping[str, float]) -> dict[int, complex]:
    """Order → relative amplitude of what manufacturing scatter splits it by."""
    return {
        int(name.split()[1]): complex(value, values[f"{name[:-2]}im"])
        for name, value in values.items()
        if name.startswith("scatter") and name.endswith("re")
    }


def sinking_of(test: str) -> str:
    """Name of the coordinate that tells how far a test's lines sink in, in standard deviations."""
    return f"sinking {test}"


def _weight(stage: str, mass_kg: float, sd_kg: float) -> Constant:
    return Constant(f"{stage}:mass_kg", mass_kg, sd_kg, 0.01 * mass_kg, 100 * mass_kg)


def _loss(name: str, source: str) -> Constant:
    low, high = WINDING_LOSS if source in ("winding", "overhang") else STEEL_LOSS
    spread = math.log(high / low) / (2 * Z95)
    return Constant(name, math.sqrt(low * high), spread, *LOSS_LIMITS, log=True)


def _constant(name: str, p: Parameter) -> Constant:
    if p.fixed:
        return Constant(name, p.median, FIXED * (abs(p.median) or 1.0), -np.inf, np.inf)
    log = p.scale == "log"
    low, high = (np.log(v) if log else v for v in (p.low90, p.high90))
    return Constant(name, p.median, float(high - low) / (2 * Z95), p.lower, p.upper, log)
