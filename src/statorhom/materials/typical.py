"""What is known of a region's constants before anything is measured, as priors."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

from statorhom.errors import MaterialError
from statorhom.materials.symmetry import constant_names
from statorhom.materials.transversely_isotropic import TransverselyIsotropic
from statorhom.materials.typical_ranges import typical_region

_GPA = 1e9
# the role that each constant of a symmetry plays in `typical_ranges`, in the constructor's order
_ROLES = {
    "isotropic": ("E", "nu"),
    "transversely_isotropic": ("E_p", "E_z", "nu_p", "nu_pz", "G_rz"),
    "orthotropic": ("E_p", "E_p", "E_z", "nu_p", "nu_pz", "nu_pz", "G_p", "G_rz", "G_rz"),
}


@dataclass(frozen=True)
class ConstantPrior:
    """Prior of one engineering constant, in Pa or without unit.

    Parameters
    ----------
    median, low90, high90 : float
        50, 5 and 95 % quantile; the median need not lie in the middle.
    lower_bound, upper_bound : float
        Limits that no value may pass.
    scale : "log" or "linear"
        Normal in the logarithm (moduli) or in the value (Poisson's ratios).
    """

    median: float
    low90: float
    high90: float
    lower_bound: float
    upper_bound: float
    scale: Literal["log", "linear"]


def prior_range(
    region: str,
    stage_kind: str,
    symmetry: str,
    constant: str,
    analytic: TransverselyIsotropic | None = None,
) -> ConstantPrior:
    """Return the prior of a constant from what is typical of its region.

    An analytic value moves the median halfway towards itself (in the logarithm for moduli) and widens
    the range where it lies outside. It is a start: it never narrows the range, since contacts, voids
    and workmanship count more than the constituents.

    Parameters
    ----------
    region : str
        lamination, winding, overhang, frame or machine.
    stage_kind : str
        The fabrication step; a winding is softer before its impregnation.
    symmetry, constant : str
        As in study files.
    analytic : TransverselyIsotropic, optional
        The region's homogenized constituents.

    Raises
    ------
    MaterialError
        Unknown region, symmetry or constant.
    """
    role = _role(symmetry, constant)
    typical = typical_region(region, stage_kind)
    unit = _GPA if constant.endswith("_pa") else 1.0
    low, high = (unit * end for end in typical.ranges[role])
    lower, upper = (unit * end for end in typical.limits(role))
    scale: Literal["log", "linear"] = "log" if unit == _GPA else "linear"
    median = _middle(low, high, scale)
    estimate = None if analytic is None else _analytic_value(analytic, role)
    if estimate is not None and lower < estimate < upper:
        median = _middle(median, estimate, scale)
        low, high = min(low, estimate), max(high, estimate)
    return ConstantPrior(median, low, high, lower, upper, scale)


def _role(symmetry: str, constant: str) -> str:
    names, numbered = constant_names(symmetry), constant_names(symmetry, numbered=True)
    if constant in numbered:
        names = numbered
    if constant not in names:
        raise MaterialError(
            f"{symmetry} material has no constant {constant!r}: use one of {', '.join(names)}"
        )
    return _ROLES[symmetry][names.index(constant)]


def _middle(low: float, high: float, scale: Literal["log", "linear"]) -> float:
    return math.sqrt(low * high) if scale == "log" else (low + high) / 2.0


def _analytic_value(analytic: TransverselyIsotropic, role: str) -> float | None:
    """Return the analytic constant of a role; none stands for an isotropic material's Poisson's ratio."""
    values = {
        "E": analytic.E_p_pa,
        "E_p": analytic.E_p_pa,
        "E_z": analytic.E_z_pa,
        "G_p": analytic.G_p_pa,
        "G_rz": analytic.G_rz_pa,
        "nu_p": analytic.nu_p,
        "nu_pz": analytic.nu_pz,
    }
    return values.get(role)
