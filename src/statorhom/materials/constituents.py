"""Handbook values of what stators are made of: enough for a start, never a result."""

from __future__ import annotations

from dataclasses import dataclass

from statorhom.materials.isotropic import Isotropic


@dataclass(frozen=True)
class Constituent:
    """A homogeneous raw material.

    Parameters
    ----------
    material : Isotropic
    density_kg_m3 : float
    """

    material: Isotropic
    density_kg_m3: float


ELECTRICAL_STEEL = Constituent(Isotropic(E_pa=205e9, nu=0.29), density_kg_m3=7650.0)
SHEET_COATING = Constituent(Isotropic(E_pa=3e9, nu=0.35), density_kg_m3=1600.0)
COPPER = Constituent(Isotropic(E_pa=120e9, nu=0.34), density_kg_m3=8960.0)
WIRE_ENAMEL = Constituent(Isotropic(E_pa=3e9, nu=0.35), density_kg_m3=1400.0)
IMPREGNATING_RESIN = Constituent(Isotropic(E_pa=3e9, nu=0.35), density_kg_m3=1200.0)
