"""Regions of a stator, the steps that add them, and the elastic constants of the symmetries."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Literal

Region = Literal["lamination", "winding", "overhang", "frame", "machine"]
StageKind = Literal["stack", "wound", "impregnated", "framed", "machine"]
Symmetry = Literal["isotropic", "transversely_isotropic", "orthotropic"]

REGIONS: tuple[Region, ...] = ("lamination", "winding", "overhang", "frame", "machine")

#: Regions that a step adds or changes, the steps in the order of fabrication.
REGIONS_OF_KIND: Mapping[StageKind, tuple[Region, ...]] = MappingProxyType(
    {
        "stack": ("lamination",),
        "wound": ("winding", "overhang"),
        "impregnated": ("winding", "overhang"),
        "framed": ("frame",),
        "machine": ("machine",),
    }
)

STAGE_KINDS: tuple[StageKind, ...] = tuple(REGIONS_OF_KIND)

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


def is_modulus(constant: str) -> bool:
    """Whether the constant is a modulus in pascal (positive), not a Poisson ratio."""
    return constant.endswith("_pa")
