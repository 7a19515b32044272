"""Transversely isotropic materials: five constants, axis 3 = z is the axis of symmetry."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from statorhom.materials.conditions import check_conditions, check_finite, check_positive
from statorhom.materials.hooke import Hooke
from statorhom.materials.recovery import check_recovered


@dataclass(frozen=True)
class TransverselyIsotropic:
    """A material with one preferred direction: a stack of sheets, a bundle of wires.

    Parameters
    ----------
    E_p_pa, E_z_pa : float
        Young's moduli in the plane of isotropy and along z, in Pa.
    nu_p : float
        Poisson's ratio in the plane.
    nu_pz : float
        −ε_z/ε_p under load in the plane, so that S13 = −nu_pz/E_p.
    G_rz_pa : float
        Shear modulus between the plane and z, C44, in Pa.

    Raises
    ------
    MaterialError
        A modulus is not positive, or one of the two conditions on the Poisson's ratios is violated
        (S11 − S12 > 0 and (S11 + S12) S33 > 2 S13², see J. F. Nye, Physical Properties of Crystals,
        1957, section VIII.4); |nu_pz| < √(E_p/E_z) follows from these two.
    """

    E_p_pa: float
    E_z_pa: float
    nu_p: float
    nu_pz: float
    G_rz_pa: float

    symmetry: ClassVar[str] = "transversely_isotropic"

    def __post_init__(self) -> None:
        check_finite(self.symmetry, vars(self))
        check_positive(self.symmetry, vars(self))
        limit = 1.0 - 2.0 * self.nu_pz**2 * self.E_z_pa / self.E_p_pa
        check_conditions(
            self.symmetry,
            (
                (self.nu_p > -1.0, f"nu_p must stay above -1, is {self.nu_p:.6g}"),
                (
                    self.nu_p < limit,
                    f"nu_p must stay below 1 - 2 nu_pz^2 E_z/E_p = {limit:.6g}, is {self.nu_p:.6g}",
                ),
            ),
        )

    @property
    def G_p_pa(self) -> float:
        """Shear modulus in the plane of isotropy, C66 = E_p / 2(1+ν_p), in Pa."""
        return self.E_p_pa / (2.0 * (1.0 + self.nu_p))

    def hooke(self) -> Hooke:
        """Stiffness matrix, from inverting the normal block of the compliance in closed form."""
        c33_by_ez = 1.0 / (1.0 - 2.0 * self.nu_pz**2 * self.E_z_pa / (self.E_p_pa * (1.0 - self.nu_p)))
        c13 = self.E_z_pa * self.nu_pz / (1.0 - self.nu_p) * c33_by_ez
        # C11 + C12 and C11 − C12: biaxial stretch and shear in the plane
        biaxial = self.E_p_pa / (1.0 - self.nu_p) * c33_by_ez
        c11, c12 = biaxial / 2.0 + self.G_p_pa, biaxial / 2.0 - self.G_p_pa
        matrix = np.diag([c11, c11, self.E_z_pa * c33_by_ez, self.G_rz_pa, self.G_rz_pa, self.G_p_pa])
        matrix[0, 1] = matrix[1, 0] = c12
        matrix[:2, 2] = matrix[2, :2] = c13
        return Hooke(matrix)

    @classmethod
    def from_hooke(cls, hooke: Hooke) -> TransverselyIsotropic:
        """Return the constants of a stiffness matrix that is isotropic in the 1-2 plane.

        Raises
        ------
        MaterialError
            The matrix has another symmetry, or is not positive definite.
        """
        hooke.check_positive_definite()
        s = hooke.compliance
        material = cls(
            E_p_pa=float(1.0 / s[0, 0]),
            E_z_pa=float(1.0 / s[2, 2]),
            nu_p=float(-s[0, 1] / s[0, 0]),
            nu_pz=float(-s[0, 2] / s[0, 0]),
            G_rz_pa=float(1.0 / s[3, 3]),
        )
        check_recovered(cls.symmetry, hooke, material.hooke())
        return material
