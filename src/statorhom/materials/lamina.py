"""A thin orthotropic sheet: what a ply's tests give, and the solid that it is part of."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from statorhom.errors import MaterialError
from statorhom.materials.conditions import check_conditions, check_finite, check_positive
from statorhom.materials.orthotropic import Orthotropic
from statorhom.materials.rotation import Array

STEEPEST_DEG = 90.0


@dataclass(frozen=True)
class Lamina:
    """A ply in plane stress: four of its five constants are independent, as ν₂₁ = ν₁₂ E₂₂/E₁₁.

    Parameters
    ----------
    E_1_pa, E_2_pa : float
        Young's moduli along the ply's axes 1 and 2 in Pa.
    nu_12 : float
        −ε₂/ε₁ under load along 1.
    G_12_pa : float
        Shear modulus in its plane in Pa.

    Raises
    ------
    MaterialError
        A modulus is not positive, or |ν₁₂| ≥ √(E₁/E₂) (R. M. Jones, Mechanics of Composite Materials, 1975,
        section 2.4).
    """

    E_1_pa: float
    E_2_pa: float
    nu_12: float
    G_12_pa: float

    kind: ClassVar[str] = "ply"

    def __post_init__(self) -> None:
        check_finite(self.kind, vars(self))
        check_positive(self.kind, vars(self))
        limit = math.sqrt(self.E_1_pa / self.E_2_pa)
        check_conditions(
            self.kind,
            (
                (
                    abs(self.nu_12) < limit,
                    f"|nu_12| must stay below sqrt(E_1/E_2) = {limit:.6g}, is {abs(self.nu_12):.6g}",
                ),
            ),
        )

    @classmethod
    def woven(cls, E_pa: float, nu: float, G_pa: float) -> Lamina:
        """Return a balanced cloth: as many fibres along as across, so E₁ = E₂ while G₁₂ stays free."""
        return cls(E_pa, E_pa, nu, G_pa)

    @property
    def nu_21(self) -> float:
        """−ε₁/ε₂ under load along 2."""
        return self.nu_12 * self.E_2_pa / self.E_1_pa

    @property
    def reduced(self) -> Array:
        """Stiffness Q of plane stress in the ply's axes, shape (3, 3), order 11, 22, 12, in Pa."""
        free = 1.0 - self.nu_12 * self.nu_21
        Q = np.zeros((3, 3))
        Q[0, 0], Q[1, 1] = self.E_1_pa / free, self.E_2_pa / free
        Q[0, 1] = Q[1, 0] = self.nu_12 * self.E_2_pa / free
        Q[2, 2] = self.G_12_pa
        return Q

    def turned(self, angle_deg: float) -> Array:
        """Stiffness Q̄ of plane stress in the laminate's axes, shape (3, 3).

        Q̄ = T⁻¹ Q T⁻ᵀ, where T turns stresses from the laminate's axes into the ply's (Jones 1975, section 2.6).

        Parameters
        ----------
        angle_deg : float
            From the laminate's axis 1 to the ply's axis 1, towards axis 2; −90 … 90.

        Raises
        ------
        MaterialError
            The angle lies outside.
        """
        check_angle(angle_deg)
        back = stress_turn(-math.radians(angle_deg))  # T⁻¹ is the turn the other way
        Q: Array = back @ self.reduced @ back.T
        return Q

    def solid(self, E_3_pa: float, nu_13: float, nu_23: float, G_13_pa: float, G_23_pa: float) -> Orthotropic:
        """Return the ply as a solid, with what a test in its plane cannot tell.

        Raises
        ------
        MaterialError
            No material has these constants.
        """
        return Orthotropic(
            self.E_1_pa, self.E_2_pa, E_3_pa, self.nu_12, nu_13, nu_23, self.G_12_pa, G_13_pa, G_23_pa
        )


def stress_turn(angle: float) -> Array:
    """Matrix T that turns plane stresses (11, 22, 12) into axes at an angle (rad), shape (3, 3)."""
    c, s = math.cos(angle), math.sin(angle)
    return np.array([[c * c, s * s, 2 * s * c], [s * s, c * c, -2 * s * c], [-s * c, s * c, c * c - s * s]])


def check_angle(angle_deg: float) -> None:
    """Refuse what is no angle of a ply.

    Raises
    ------
    MaterialError
        It lies outside −90 … 90 degrees, where every direction has its angle once.
    """
    if not abs(angle_deg) <= STEEPEST_DEG:
        raise MaterialError(
            f"ply: angle_deg must lie in -90 … 90, is {angle_deg:.6g}: add or subtract 180 until it does"
        )
