"""The five moduli in which fibre composites are written (Hill 1964), fibres along z."""

from __future__ import annotations

from dataclasses import dataclass

from statorhom.errors import MaterialError
from statorhom.materials.isotropic import Isotropic
from statorhom.materials.transversely_isotropic import TransverselyIsotropic


@dataclass(frozen=True)
class HillModuli:
    """Moduli of a phase or of a composite that is isotropic across its fibres.

    Unlike engineering constants they can also describe a void.

    Parameters
    ----------
    E_L_pa : float
        Young's modulus along the fibres.
    nu_l : float
        −ε_T/ε_L under load along the fibres.
    k_pa : float
        Plane-strain bulk modulus (C11 + C12)/2; E/[2(1+ν)(1−2ν)] where isotropic.
    G_T_pa, G_L_pa : float
        Shear moduli across (C66) and along (C44) the fibres.
    """

    E_L_pa: float
    nu_l: float
    k_pa: float
    G_T_pa: float
    G_L_pa: float

    @classmethod
    def of(cls, material: Isotropic | TransverselyIsotropic) -> HillModuli:
        """Return the moduli of a homogeneous phase."""
        c = material.hooke().matrix
        k = float(c[0, 0] + c[0, 1]) / 2.0
        nu = float(c[0, 2]) / (2.0 * k)
        return cls(
            E_L_pa=float(c[2, 2]) - 4.0 * k * nu**2,
            nu_l=nu,
            k_pa=k,
            G_T_pa=float(c[5, 5]),
            G_L_pa=float(c[3, 3]),
        )

    def engineering(self) -> TransverselyIsotropic:
        """Return the engineering constants, E_T = 4 k G_T / [k + (1 + 4 k ν_L²/E_L) G_T] (Hill 1964).

        Raises
        ------
        MaterialError
            A modulus vanishes, as in a void.
        """
        if min(self.E_L_pa, self.k_pa, self.G_T_pa, self.G_L_pa) <= 0.0:
            raise MaterialError("fibre composite: a modulus vanishes, a void has no engineering constants")
        k, g = self.k_pa, self.G_T_pa
        across = 4.0 * k * g / (k + (1.0 + 4.0 * k * self.nu_l**2 / self.E_L_pa) * g)
        return TransverselyIsotropic(
            E_p_pa=across,
            E_z_pa=self.E_L_pa,
            nu_p=across / (2.0 * g) - 1.0,
            nu_pz=self.nu_l * across / self.E_L_pa,
            G_rz_pa=self.G_L_pa,
        )


VOID = HillModuli(E_L_pa=0.0, nu_l=0.0, k_pa=0.0, G_T_pa=0.0, G_L_pa=0.0)
