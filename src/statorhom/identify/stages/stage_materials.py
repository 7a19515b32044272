"""From the fit's constants to the materials of a stage's regions."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from statorhom.materials.symmetry import SYMMETRIES, constant_names
from statorhom.model.affine import Material, Materials, hooke_coefficients

DENSITY = "density_kg_m3"
STEP = 1e-6  # relative; Hooke entries are smooth functions of the constants


@dataclass(frozen=True)
class RegionModel:
    """A region and the symmetry that the engineer believes it has; `source` lends its material where it has none.

    A coupon's axes are `numbered` 1, 2, 3. Lumps have a `density` of their own, which nobody identifies.
    """

    region: str
    symmetry: str
    source: str
    numbered: bool = False
    density: float | None = None

    @property
    def constants(self) -> tuple[str, ...]:
        """Names of the region's engineering constants."""
        return constant_names(self.symmetry, numbered=self.numbered)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the region's constants in a fit."""
        return tuple(f"{self.source}.{constant}" for constant in self.constants)

    def material(self, values: Mapping[str, float]) -> Material:
        """Material of the region at the given constants.

        Raises
        ------
        MaterialError
            If no material has these constants.
        """
        symmetry = SYMMETRIES[self.symmetry](*(values[name] for name in self.names))
        return Material(symmetry.hooke(), values[f"{self.source}.{DENSITY}"])

    def weighted(self, material: Material) -> Material:
        """The source's material with the region's own density, where it has one."""
        return material if self.density is None else replace(material, density=self.density)


@dataclass(frozen=True)
class StageMaterials:
    """All regions of a stage."""

    regions: tuple[RegionModel, ...]

    def of(self, values: Mapping[str, float]) -> Materials:
        """Materials of all regions; regions of one source share one object."""
        found: dict[str, Material] = {}
        for region in self.regions:
            if region.source not in found:
                found[region.source] = region.material(values)
        return {r.region: r.weighted(found[r.source]) for r in self.regions}

    def hooke_slopes(self, values: Mapping[str, float]) -> dict[str, dict[str, np.ndarray]]:
        """Region → constant → derivative of the region's nine Hooke entries, by central differences."""
        slopes: dict[str, dict[str, np.ndarray]] = {}
        for region in self.regions:
            if region.source not in slopes:
                slopes[region.source] = {name: _slope(region, values, name) for name in region.names}
        return {region.region: slopes[region.source] for region in self.regions}

    @property
    def names(self) -> tuple[str, ...]:
        """Names of all constants, densities included."""
        found: dict[str, None] = {}
        for region in self.regions:
            found |= dict.fromkeys((*region.names, f"{region.source}.{DENSITY}"))
        return tuple(found)

    def log_frequency_slopes(
        self,
        gradient: Mapping[str, tuple[np.ndarray, float]],
        slopes: Mapping[str, Mapping[str, np.ndarray]],
    ) -> dict[str, float]:
        """Derivative of a mode's ln f with respect to every constant and density.

        Parameters
        ----------
        gradient : region → derivative with respect to its Hooke entries and to its density.
        slopes : see `hooke_slopes`.
        """
        found = dict.fromkeys(self.names, 0.0)
        for region in self.regions:
            hooke, density = gradient[region.region]
            for name, slope in slopes[region.region].items():
                found[name] += float(hooke @ slope)
            if region.density is None:
                found[f"{region.source}.{DENSITY}"] += density
        return found

    @property
    def constants(self) -> dict[str, tuple[str, ...]]:
        """Region that owns constants → their names."""
        return {r.source: r.constants for r in self.regions if r.source == r.region}

    @property
    def sources(self) -> dict[str, str]:
        """Region that owns constants → its symmetry."""
        return {r.source: r.symmetry for r in self.regions if r.source == r.region}


def _slope(region: RegionModel, values: Mapping[str, float], name: str) -> np.ndarray:
    step = STEP * (abs(values[name]) or 1.0)
    low, high = (
        hooke_coefficients(region.material({**values, name: values[name] + sign * step}).hooke)
        for sign in (-1, 1)
    )
    return (high - low) / (2 * step)
