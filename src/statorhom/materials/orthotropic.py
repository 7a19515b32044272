"""Orthotropic materials: nine constants in the axes r, θ, z."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from statorhom.materials.conditions import check_conditions, check_finite, check_positive
from statorhom.materials.hooke import Hooke
from statorhom.materials.recovery import check_recovered
from statorhom.materials.rotation import Array


@dataclass(frozen=True)
class Orthotropic:
    """A material with three planes of symmetry.

    Parameters
    ----------
    E_r_pa, E_t_pa, E_z_pa : float
        Young's moduli along r, θ and z in Pa.
    nu_rt, nu_rz, nu_tz : float
        nu_ij = −ε_j/ε_i under load along i, so that S_ij = −nu_ij/E_i.
    G_rt_pa, G_rz_pa, G_tz_pa : float
        Shear moduli in Pa.

    Raises
    ------
    MaterialError
        A modulus is not positive, |nu_ij| ≥ √(E_i/E_j), or the determinant of the normal block is not
        positive (R. M. Jones, Mechanics of Composite Materials, 1975, section 2.4).
    """

    E_r_pa: float
    E_t_pa: float
    E_z_pa: float
    nu_rt: float
    nu_rz: float
    nu_tz: float
    G_rt_pa: float
    G_rz_pa: float
    G_tz_pa: float

    symmetry: ClassVar[str] = "orthotropic"

    def __post_init__(self) -> None:
        check_finite(self.symmetry, vars(self))
        check_positive(self.symmetry, vars(self))
        check_conditions(
            self.symmetry,
            (
                _below_root("nu_rt", self.nu_rt, "E_r/E_t", self.E_r_pa / self.E_t_pa),
                _below_root("nu_rz", self.nu_rz, "E_r/E_z", self.E_r_pa / self.E_z_pa),
                _below_root("nu_tz", self.nu_tz, "E_t/E_z", self.E_t_pa / self.E_z_pa),
                self._positive_determinant(),
            ),
        )

    def _positive_determinant(self) -> tuple[bool, str]:
        nu_tr = self.nu_rt * self.E_t_pa / self.E_r_pa
        nu_zr = self.nu_rz * self.E_z_pa / self.E_r_pa
        nu_zt = self.nu_tz * self.E_z_pa / self.E_t_pa
        determinant = (
            1.0
            - self.nu_rt * nu_tr
            - self.nu_tz * nu_zt
            - self.nu_rz * nu_zr
            - 2.0 * self.nu_rt * self.nu_tz * nu_zr
        )
        return determinant > 0.0, (
            "1 - nu_rt nu_tr - nu_tz nu_zt - nu_rz nu_zr - 2 nu_rt nu_tz nu_zr must stay positive, "
            f"is {determinant:.6g}: make the Poisson's ratios smaller"
        )

    def _compliance(self) -> Array:
        diagonal = (self.E_r_pa, self.E_t_pa, self.E_z_pa, self.G_tz_pa, self.G_rz_pa, self.G_rt_pa)
        compliance: Array = np.diag(1.0 / np.array(diagonal))
        compliance[0, 1] = compliance[1, 0] = -self.nu_rt / self.E_r_pa
        compliance[0, 2] = compliance[2, 0] = -self.nu_rz / self.E_r_pa
        compliance[1, 2] = compliance[2, 1] = -self.nu_tz / self.E_t_pa
        return compliance

    def hooke(self) -> Hooke:
        """Stiffness matrix, the inverse of the compliance."""
        return Hooke(_inverse(self._compliance()))

    @classmethod
    def from_hooke(cls, hooke: Hooke) -> Orthotropic:
        """Return the constants of a stiffness matrix whose axes are those of orthotropy.

        Raises
        ------
        MaterialError
            The matrix has another symmetry, or is not positive definite.
        """
        hooke.check_positive_definite()
        s = hooke.compliance
        moduli = [float(1.0 / entry) for entry in np.diag(s)]
        material = cls(
            E_r_pa=moduli[0],
            E_t_pa=moduli[1],
            E_z_pa=moduli[2],
            nu_rt=float(-s[0, 1] / s[0, 0]),
            nu_rz=float(-s[0, 2] / s[0, 0]),
            nu_tz=float(-s[1, 2] / s[1, 1]),
            G_rt_pa=moduli[5],
            G_rz_pa=moduli[4],
            G_tz_pa=moduli[3],
        )
        check_recovered(cls.symmetry, hooke, material.hooke())
        return material


def _inverse(compliance: Array) -> Array:
    """Invert after scaling the diagonal to one: soft and stiff directions then keep the same digits."""
    root = 1.0 / np.sqrt(np.diag(compliance))
    scale = np.outer(root, root)
    stiffness: Array = scale * np.linalg.inv(scale * compliance).astype(float)
    return (stiffness + stiffness.T) / 2.0


def _below_root(name: str, nu: float, ratio_name: str, ratio: float) -> tuple[bool, str]:
    limit = math.sqrt(ratio)
    return abs(nu) < limit, f"|{name}| must stay below sqrt({ratio_name}) = {limit:.6g}, is {abs(nu):.6g}"
