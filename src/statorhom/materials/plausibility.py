"""Densities that no mixture of a step's materials can have: the sign of a mistyped weight or dimension."""

from __future__ import annotations

import math
from dataclasses import dataclass

from statorhom.materials.constituents import COPPER, SHEET_COATING
from statorhom.materials.density import RegionDensity

_SILICON_STEEL = 7600.0
_PURE_IRON = 7870.0
_LEAST_STACKING_FACTOR = 0.9
_MAGNESIUM_ALLOY = 1700.0
_STAINLESS_STEEL = 8000.0
# a density is doubted when its error would have to exceed this many standard deviations
_DEVIATIONS = 2.0

_MIXTURES = {
    "lamination": "electrical steel with its coating",
    "winding": "copper, insulation, resin and air",
    "frame": "frames of magnesium to steel",
}


@dataclass(frozen=True)
class DensityWarning:
    """A density outside its plausible range.

    Parameters
    ----------
    region : str
    density_kg_m3, low_kg_m3, high_kg_m3 : float
    message : str
        One line for the terminal and the report.
    """

    region: str
    density_kg_m3: float
    low_kg_m3: float
    high_kg_m3: float
    message: str


def plausible_range(region: str) -> tuple[float, float]:
    """Return the lowest and highest density in kg/m³ that a region can have.

    lamination
        7000 … 7870: from silicon steel (7600) at a stacking factor of 0.9, the rest coating (1600), to
        pure iron without any gap. Cobalt-iron sheets (about 8120) lie above it.
    winding
        0 … 8960: air to solid copper; a winding of aluminium lies inside.
    frame
        1700 … 8000: magnesium alloy to stainless steel, with aluminium, cast iron and steel between.
    any other
        0 … ∞: a machine's last step adds bearings and a rotor too, which the region's volume does not
        contain.
    """
    ranges = {
        "lamination": (
            _LEAST_STACKING_FACTOR * _SILICON_STEEL
            + (1.0 - _LEAST_STACKING_FACTOR) * SHEET_COATING.density_kg_m3,
            _PURE_IRON,
        ),
        "winding": (0.0, COPPER.density_kg_m3),
        "frame": (_MAGNESIUM_ALLOY, _STAINLESS_STEEL),
    }
    return ranges.get(region, (0.0, math.inf))


def density_warning(density: RegionDensity) -> DensityWarning | None:
    """Doubt a density that lies outside its range by more than two standard deviations.

    Returns
    -------
    DensityWarning or None
        None where the density is plausible.
    """
    low, high = plausible_range(density.region)
    rho, margin = density.density_kg_m3, _DEVIATIONS * density.density_sd_kg_m3
    if low <= rho + margin and rho - margin <= high:
        return None
    message = (
        f"stage {density.stage!r}: the {density.region} would have {rho:.0f} kg/m³, but "
        f"{_MIXTURES[density.region]} can only have {low:.0f} … {high:.0f} kg/m³; "
        f"check mass_kg of this stage and of the one before, and the dimensions in the geometry file"
    )
    return DensityWarning(density.region, rho, low, high, message)
