"""Regions of a stator or a coupon, the steps that add them, and the elastic constants of the symmetries."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from types import MappingProxyType
from typing import Literal

# a wing's regions are its materials, and their names are the user's
Region = str
StageKind = Literal["stack", "wound", "impregnated", "framed", "machine", "coupon"]
Symmetry = Literal["isotropic", "transversely_isotropic", "orthotropic"]

#: Regions of coupons: a test piece has one, named after its kind.
COUPON_REGIONS: tuple[Region, ...] = ("plate", "beam", "tube")
REGIONS: tuple[Region, ...] = ("lamination", "winding", "overhang", "frame", "machine", *COUPON_REGIONS)

#: Regions that are the core of a ring: the sheets of a stator, the wall of a tube.
CORES: tuple[Region, ...] = ("lamination", "tube")

#: Regions that a step adds or changes, the steps in the order of fabrication.
REGIONS_OF_KIND: Mapping[StageKind, tuple[Region, ...]] = MappingProxyType(
    {
        "stack": ("lamination",),
        "wound": ("winding", "overhang"),
        "impregnated": ("winding", "overhang"),
        "framed": ("frame",),
        "machine": ("machine",),
        "coupon": COUPON_REGIONS,
    }
)

#: The one stage of a test piece.
COUPON: StageKind = "coupon"
#: The steps of a stator, in the order of fabrication.
STAGE_KINDS: tuple[StageKind, ...] = tuple(kind for kind in REGIONS_OF_KIND if kind != COUPON)

#: Engineering constants of a symmetry, as they are named in files; those ending in ``_pa`` are moduli.
CONSTANTS: Mapping[Symmetry, tuple[str, ...]] = MappingProxyType(
    {
        "isotropic": ("E_pa", "nu"),
        "transversely_isotropic": ("E_p_pa", "E_z_pa", "nu_p", "nu_pz", "G_rz_pa"),
        "orthotropic": (
            "E_r_pa",
            "E_t_pa",
            "E_z_pa",
            "nu_rt",
            "nu_rz",
            "nu_tz",
            "G_rt_pa",
            "G_rz_pa",
            "G_tz_pa",
        ),
    }
)


#: The same of a coupon: its axes are 1, 2, 3 instead of r, θ, z where all three differ.
COUPON_CONSTANTS: Mapping[Symmetry, tuple[str, ...]] = MappingProxyType(
    {
        **CONSTANTS,
        "orthotropic": (
            "E_1_pa",
            "E_2_pa",
            "E_3_pa",
            "nu_12",
            "nu_13",
            "nu_23",
            "G_12_pa",
            "G_13_pa",
            "G_23_pa",
        ),
    }
)


def core_region(regions: Iterable[Region]) -> Region:
    """The one of a ring's regions that is its core: it carries lumps, springs and supports.

    Parameters
    ----------
    regions : of a mesh, of materials or of a study's step, in any order.

    Raises
    ------
    ValueError
        If none of them is the core of a ring.
    """
    found = [region for region in regions if region in CORES]
    if len(found) != 1:
        raise ValueError(f"a ring has one region of {', '.join(CORES)}, not {found}")
    return found[0]


def is_modulus(constant: str) -> bool:
    """Whether the constant is a modulus in pascal (positive), not a Poisson ratio."""
    return constant.endswith("_pa")
