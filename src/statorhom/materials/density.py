"""Densities of the regions from the chain of weighings: ρ = Δm / v (equation 3 of the seed paper)."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from types import MappingProxyType

from statorhom.errors import MassError

REGION_OF_STEP: Mapping[str, str] = MappingProxyType(
    {
        "stack": "lamination",
        "wound": "winding",
        "impregnated": "winding",
        "framed": "frame",
        "machine": "machine",
    }
)


@dataclass(frozen=True)
class Weighing:
    """The scale's reading after one fabrication step.

    Parameters
    ----------
    stage : str
        The stage's name, for messages.
    kind : str
        The step: a key of `REGION_OF_STEP`.
    mass_kg, mass_sd_kg : float
        Total mass and its standard deviation.
    """

    stage: str
    kind: str
    mass_kg: float
    mass_sd_kg: float

    def __str__(self) -> str:
        return f"{self.mass_kg:.6g} kg after {self.stage!r}"


@dataclass(frozen=True)
class RegionDensity:
    """Mean density of a region after a step.

    Parameters
    ----------
    stage, region : str
    mass_kg, volume_m3 : float
        What was added, over the volume it fills in the model.
    density_kg_m3, density_sd_kg_m3 : float
        The standard deviation comes from both weighings; the volume counts as exact.
    """

    stage: str
    region: str
    mass_kg: float
    volume_m3: float
    density_kg_m3: float
    density_sd_kg_m3: float


def densities(weighings: Sequence[Weighing], volumes_m3: Mapping[str, float]) -> tuple[RegionDensity, ...]:
    """Return the density of the region that each step adds or changes, in the order of the steps.

    The winding's counts everything added to the slots and overhangs since the stack was weighed:
    copper, then copper and resin.

    Parameters
    ----------
    weighings : sequence of Weighing
        In the order of fabrication.
    volumes_m3 : mapping
        Volume of each region; that of an own region `overhang` is added to the winding's.

    Raises
    ------
    MassError
        A step loses mass or adds none to a new region, the weight before a region is missing, or the
        model has no volume for it.
    """
    check_no_loss(weighings)
    return tuple(_density(weighings[: i + 1], volumes_m3) for i in range(len(weighings)))


def check_no_loss(weighings: Sequence[Weighing]) -> None:
    """Refuse a step after which less is on the scale than before.

    Raises
    ------
    MassError
        With both weights and their difference.
    """
    for before, after in pairwise(weighings):
        if after.mass_kg < before.mass_kg:
            raise MassError(
                f"mass_kg: {after} is less than {before}, a loss of {before.mass_kg - after.mass_kg:.4g} kg, "
                f"but a step can only add mass: correct one of the two weights"
            )


def _density(weighings: Sequence[Weighing], volumes_m3: Mapping[str, float]) -> RegionDensity:
    last = weighings[-1]
    region = REGION_OF_STEP[last.kind]
    base_kg, base_sd_kg = _before(weighings)
    mass = last.mass_kg - base_kg
    if mass <= 0.0:
        raise MassError(
            f"mass_kg: {last} leaves {mass:.4g} kg for the region {region}: "
            f"correct this weight or the one before"
        )
    volume = _volume(last, region, volumes_m3)
    return RegionDensity(
        stage=last.stage,
        region=region,
        mass_kg=mass,
        volume_m3=volume,
        density_kg_m3=mass / volume,
        density_sd_kg_m3=math.hypot(last.mass_sd_kg, base_sd_kg) / volume,
    )


def whole_density(weighing: Weighing, region: str, volume_m3: float) -> RegionDensity:
    """Density of an object that is one region."""
    return RegionDensity(
        stage=weighing.stage,
        region=region,
        mass_kg=weighing.mass_kg,
        volume_m3=volume_m3,
        density_kg_m3=weighing.mass_kg / volume_m3,
        density_sd_kg_m3=weighing.mass_sd_kg / volume_m3,
    )


def shared_densities(
    weighing: Weighing, volumes_m3: Mapping[str, float], known: Mapping[str, float], lumps_kg: float
) -> tuple[RegionDensity, ...]:
    """Densities of an object that is weighed as a whole and made of several materials.

    Parameters
    ----------
    weighing : of the whole.
    volumes_m3 : volume of each region.
    known : densities in kg/m³ of all regions but one, which the weight gives; or of all, which it scales.
    lumps_kg : part of the weight that belongs to no region.

    Raises
    ------
    MassError
        If nothing is left for the regions.
    """
    fixed = {region: known[region] * v for region, v in volumes_m3.items() if region in known}
    rest = weighing.mass_kg - lumps_kg
    if len(fixed) < len(volumes_m3):
        rest -= sum(fixed.values())
    if rest <= 0.0:
        raise MassError(
            f"mass_kg: {weighing} is no more than the parts of known mass together, "
            f"{weighing.mass_kg - rest:.4g} kg: correct this weight, density_kg_m3 or mass_g of the lumps"
        )
    factor = rest / sum(fixed.values()) if len(fixed) == len(volumes_m3) else 1.0
    found = []
    for region, volume in volumes_m3.items():
        scaled = len(fixed) == len(volumes_m3)
        mass = factor * fixed[region] if region in fixed else rest
        sd = weighing.mass_sd_kg * (mass / rest if scaled else float(region not in fixed))
        found.append(RegionDensity(weighing.stage, region, mass, volume, mass / volume, sd / volume))
    return tuple(found)


def _before(weighings: Sequence[Weighing]) -> tuple[float, float]:
    """Mass and standard deviation of what was there before the last step's region."""
    *earlier, last = weighings
    region = REGION_OF_STEP[last.kind]
    if region == "lamination":
        return 0.0, 0.0
    others = [weighing for weighing in earlier if REGION_OF_STEP[weighing.kind] != region]
    if not others:
        raise MassError(
            f"mass_kg: {last} holds more than the {region}: "
            f"add the stage before it with its mass_kg (it may have no tests)"
        )
    return others[-1].mass_kg, others[-1].mass_sd_kg


def _volume(last: Weighing, region: str, volumes_m3: Mapping[str, float]) -> float:
    volume = volumes_m3.get(region, 0.0)
    if region == "winding":
        volume += volumes_m3.get("overhang", 0.0)
    if volume <= 0.0:
        raise MassError(
            f"stage {last.stage!r}: its mass belongs to the region {region}, "
            f"which the geometry file does not describe: add [{region}] there"
        )
    return volume
