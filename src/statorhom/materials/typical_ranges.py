"""Typical elastic constants of stators' regions.

They hold for stators in general: laminations bonded or loose, windings dry or impregnated, frames
from aluminium to steel. What users know better they say in the study file.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from statistics import NormalDist

from statorhom.errors import MaterialError
from statorhom.study.regions import COUPON

# the limits of a modulus lie this many prior standard deviations from the middle of its range
_REACH = 4.0
# a normal distribution's 90 % range reaches so many standard deviations from its middle
Z95 = NormalDist().inv_cdf(0.95)


@dataclass(frozen=True)
class TypicalRegion:
    """Typical 5 and 95 % values of a region; moduli in GPa, ceilings those of its stiffest constituent.

    The keys are the roles of constants: E and nu of an isotropic material, p in the plane, z along the
    axis, pz and rz between the two.
    """

    ranges: Mapping[str, tuple[float, float]]
    youngs_ceiling: float
    shear_ceiling: float
    highest_nu_p: float = 0.49
    highest_nu_pz: float = 0.49

    def limits(self, role: str) -> tuple[float, float]:
        """Return what a constant of this role cannot pass, in the unit of its range."""
        if role.startswith("nu"):
            return 0.0, {"nu_p": self.highest_nu_p, "nu_pz": self.highest_nu_pz}.get(role, 0.49)
        ceiling = self.youngs_ceiling if role.startswith("E") else self.shear_ceiling
        low, high = self.ranges[role]
        spread = (high / low) ** (_REACH / (2.0 * Z95))
        middle = math.sqrt(low * high)
        return middle / spread, min(middle * spread, ceiling)


_POISSON = {"nu": (0.2, 0.4), "nu_p": (0.2, 0.4), "nu_pz": (0.2, 0.4)}
# wires lead along z: ν_pz = ν_zp E_p/E_z is small, while channels and soft resin raise ν_p above ½
_WIRES = {"nu": (0.2, 0.4), "nu_p": (0.2, 0.4), "nu_pz": (0.005, 0.10)}
_METAL = {"nu": (0.22, 0.38), "nu_p": (0.22, 0.38), "nu_pz": (0.22, 0.38)}


def _winding(
    across: tuple[float, float], along: tuple[float, float], shear: tuple[float, float]
) -> TypicalRegion:
    ranges = {"E": across, "E_p": across, "E_z": along, "G_p": shear, "G_rz": shear, **_WIRES}
    return TypicalRegion(
        ranges, youngs_ceiling=130.0, shear_ceiling=48.0, highest_nu_p=0.9, highest_nu_pz=0.3
    )


def _solid(youngs: tuple[float, float], shear: tuple[float, float]) -> TypicalRegion:
    ranges = {"E": youngs, "E_p": youngs, "E_z": youngs, "G_p": shear, "G_rz": shear, **_METAL}
    return TypicalRegion(ranges, youngs_ceiling=240.0, shear_ceiling=95.0)


_LAMINATION = TypicalRegion(
    # E_z and G_rz from loose sheets (0.5, 0.3) to bonded ones (150, 45)
    {
        "E": (150.0, 205.0),
        "E_p": (150.0, 205.0),
        "E_z": (0.5, 150.0),
        "G_p": (55.0, 82.0),
        "G_rz": (0.3, 45.0),
        **_POISSON,
    },
    youngs_ceiling=240.0,
    shear_ceiling=95.0,
)
# from resin with chopped fibres to steel; carbon fibres lead stiffer, potted wires softer than what follows
_COUPON = TypicalRegion(
    {
        "E": (2.0, 210.0),
        "E_p": (2.0, 210.0),
        "E_z": (1.0, 210.0),
        "G_p": (0.5, 82.0),
        "G_rz": (0.5, 82.0),
        "nu": (0.15, 0.45),
        "nu_p": (0.05, 0.45),
        "nu_pz": (0.05, 0.45),
    },
    youngs_ceiling=500.0,
    shear_ceiling=200.0,
)
# by region, and by (region, kind of stage) where a step makes a difference
_REGIONS: Mapping[str | tuple[str, str], TypicalRegion] = {
    "lamination": _LAMINATION,
    "winding": _winding(across=(0.1, 10.0), along=(1.0, 60.0), shear=(0.03, 4.0)),
    # dry wires hold together by friction alone
    ("winding", "wound"): _winding(across=(0.03, 10.0), along=(0.3, 60.0), shear=(0.01, 4.0)),
    # in the overhangs most wires run around the machine and few along z
    "overhang": _winding(across=(0.1, 20.0), along=(0.1, 20.0), shear=(0.03, 6.0)),
    ("overhang", "wound"): _winding(across=(0.03, 20.0), along=(0.03, 20.0), shear=(0.01, 6.0)),
    # cast or extruded aluminium to steel
    "frame": _solid(youngs=(65.0, 210.0), shear=(25.0, 82.0)),
    # end shields with ribs, openings and screwed joints
    "machine": _solid(youngs=(10.0, 210.0), shear=(4.0, 82.0)),
}


def typical_region(region: str, stage_kind: str) -> TypicalRegion:
    """Return what is typical of a region at a fabrication step; coupons may be of any material.

    Raises
    ------
    MaterialError
        There is no such region.
    """
    if stage_kind == COUPON:
        return _COUPON
    found = _REGIONS.get((region, stage_kind), _REGIONS.get(region))
    if found is None:
        known = ", ".join(name for name in _REGIONS if isinstance(name, str))
        raise MaterialError(f"no typical materials are known for the region {region!r}: use one of {known}")
    return found
