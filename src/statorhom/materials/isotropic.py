"""Isotropic materials: two constants."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from statorhom.materials.conditions import check_conditions, check_finite, check_positive
from statorhom.materials.hooke import Hooke
from statorhom.materials.recovery import check_recovered


@dataclass(frozen=True)
class Isotropic:
    """A material without a preferred direction.

    Parameters
    ----------
    E_pa : float
        Young's modulus in Pa.
    nu : float
        Poisson's ratio.

    Raises
    ------
    MaterialError
        E ≤ 0, or ν outside (−1, 0.5), where the strain energy is not positive.
    """

    E_pa: float
    nu: float

    symmetry: ClassVar[str] = "isotropic"

    def __post_init__(self) -> None:
        check_finite(self.symmetry, vars(self))
        check_positive(self.symmetry, vars(self))
        check_conditions(
            self.symmetry,
            (
                (self.nu > -1.0, f"nu must stay above -1 (positive shear modulus), is {self.nu:.6g}"),
                (self.nu < 0.5, f"nu must stay below 0.5 (positive bulk modulus), is {self.nu:.6g}"),
            ),
        )

    @property
    def shear_modulus_pa(self) -> float:
        """Shear modulus μ = E / 2(1+ν) in Pa."""
        return self.E_pa / (2.0 * (1.0 + self.nu))

    @property
    def lame_pa(self) -> float:
        """Lamé's first constant λ = E ν / (1+ν)(1−2ν) in Pa."""
        return self.E_pa * self.nu / ((1.0 + self.nu) * (1.0 - 2.0 * self.nu))

    def hooke(self) -> Hooke:
        """Stiffness matrix: λ in the normal block, plus 2μ and μ on the diagonal."""
        matrix = np.zeros((6, 6))
        matrix[:3, :3] = self.lame_pa
        matrix += self.shear_modulus_pa * np.diag([2.0, 2.0, 2.0, 1.0, 1.0, 1.0])
        return Hooke(matrix)

    @classmethod
    def from_hooke(cls, hooke: Hooke) -> Isotropic:
        """Return the constants of an isotropic stiffness matrix.

        Raises
        ------
        MaterialError
            The matrix is not isotropic, or not positive definite.
        """
        hooke.check_positive_definite()
        s = hooke.compliance
        material = cls(E_pa=float(1.0 / s[0, 0]), nu=float(-s[0, 1] / s[0, 0]))
        check_recovered(cls.symmetry, hooke, material.hooke())
        return material
