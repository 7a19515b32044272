"""A winding of insulated round wires in a resin that does not fill all the space between them."""

from __future__ import annotations

from dataclasses import dataclass

from statorhom.errors import MaterialError
from statorhom.materials.homogenization.fibres import embed
from statorhom.materials.homogenization.hill_moduli import VOID, HillModuli
from statorhom.materials.homogenization.transverse_shear import TransverseShear, mori_tanaka
from statorhom.materials.isotropic import Isotropic
from statorhom.materials.transversely_isotropic import TransverselyIsotropic


@dataclass(frozen=True)
class Fill:
    """How the volume of a winding is shared; what is left over is void.

    Parameters
    ----------
    conductor, insulation, resin : float
        Shares of the volume.

    Raises
    ------
    MaterialError
        A share is impossible, or there is no resin to hold the wires.
    """

    conductor: float
    insulation: float
    resin: float

    def __post_init__(self) -> None:
        shares = (self.conductor, self.insulation, self.resin)
        listed = " + ".join(f"{share:.4g}" for share in shares)
        if not all(0.0 <= share <= 1.0 for share in shares):
            raise MaterialError(f"fill of the winding: each share of {listed} must lie in 0 … 1")
        if sum(shares) > 1.0 + 1e-9:
            raise MaterialError(f"fill of the winding: conductor + insulation + resin = {listed} exceed 1")
        if not (self.conductor > 0.0 and self.resin > 0.0):
            raise MaterialError("fill of the winding: needs both conductor and resin")

    @property
    def wires(self) -> float:
        """Share of the insulated wires."""
        return self.conductor + self.insulation

    @property
    def void(self) -> float:
        """Share that is left over."""
        return max(0.0, 1.0 - self.wires - self.resin)


def homogenize_wires(
    conductor: Isotropic,
    insulation: Isotropic,
    resin: Isotropic,
    fill: Fill,
    transverse_shear: TransverseShear = mori_tanaka,
) -> TransverselyIsotropic:
    """Homogenize a winding, wires along z, in three nested steps.

    Conductor in its insulation (inner fraction (r1/r2)²), channels of void along the wires in the
    resin, then the insulated wires in that porous resin, each by `embed`. The voids being smaller than
    the wires is an idealization: with much void the result is a start, not a bound.
    """
    inner = fill.conductor / fill.wires
    porosity = fill.void / (fill.void + fill.resin)
    wire = embed(HillModuli.of(conductor), HillModuli.of(insulation), inner, transverse_shear)
    porous = embed(VOID, HillModuli.of(resin), porosity, transverse_shear)
    return embed(wire, porous, fill.wires, transverse_shear).engineering()
