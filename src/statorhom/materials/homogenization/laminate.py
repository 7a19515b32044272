"""Laminates of anisotropic plies: plate stiffness, and the equivalent solid."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from statorhom.errors import MaterialError
from statorhom.materials.hooke import Hooke
from statorhom.materials.lamina import check_angle
from statorhom.materials.rotation import Array

# Voigt components in the plane of the plies (11, 22, 12) and through their thickness (33, 23, 13)
_IN = np.array([0, 1, 5])
_OUT = np.array([2, 3, 4])


@dataclass(frozen=True, eq=False)
class Ply:
    """One ply; its axis 3 is the laminate's normal.

    Parameters
    ----------
    hooke : Hooke
        In the ply's own axes.
    thickness_m : float
    angle_deg : float
        From the laminate's axis 1 to the ply's axis 1, towards axis 2; −90 … 90.

    Raises
    ------
    MaterialError
        The thickness is not positive, or the angle lies outside.
    """

    hooke: Hooke
    thickness_m: float
    angle_deg: float = 0.0

    def __post_init__(self) -> None:
        if not 0.0 < self.thickness_m < np.inf:
            raise MaterialError(f"ply: thickness_m must be positive and finite, is {self.thickness_m:.6g}")
        check_angle(self.angle_deg)

    def turned(self) -> Hooke:
        """Return the ply's stiffness in the laminate's axes."""
        return self.hooke.cylindrical_to_cartesian(np.radians(self.angle_deg))


@dataclass(frozen=True, eq=False)
class PlateStiffness:
    """Forces and moments per width of a thin laminate: N = A ε + B κ, M = B ε + D κ.

    Parameters
    ----------
    A, B, D : ndarray, shape (3, 3)
        Order 11, 22, 12, about the middle plane; in N/m, N and N m.
    """

    A: Array
    B: Array
    D: Array

    def __post_init__(self) -> None:
        for matrix in (self.A, self.B, self.D):
            matrix.flags.writeable = False

    @property
    def K(self) -> Array:
        """(6, 6): forces and moments per width from strains and curvatures of the middle plane."""
        return np.block([[self.A, self.B], [self.B, self.D]])

    def in_plane(self, thickness_m: float) -> tuple[float, float, float, float]:
        """E₁, E₂ and G₁₂ (Pa) and ν₁₂ of a symmetric laminate that is pulled in its plane.

        Raises
        ------
        MaterialError
            The laminate couples pulling and bending: it has no such constants.
        """
        if np.abs(self.B).max() > 1e-9 * np.abs(self.A).max() * thickness_m:
            raise MaterialError(
                "laminate: bends when it is pulled; only a symmetric one has moduli in its plane"
            )
        a = np.linalg.inv(self.A) * thickness_m
        return float(1 / a[0, 0]), float(1 / a[1, 1]), float(1 / a[2, 2]), float(-a[0, 1] / a[0, 0])


def plate_stiffness(plies: Sequence[Ply]) -> PlateStiffness:
    """Return A, B, D of classical laminate theory, the plies counted from the lower face upwards.

    A = Σ Q̄ (h_k − h_{k−1}), B = ½ Σ Q̄ (h_k² − h_{k−1}²), D = ⅓ Σ Q̄ (h_k³ − h_{k−1}³) with the
    reduced stiffness Q̄ of plane stress (R. M. Jones, Mechanics of Composite Materials, 1975, chapter 4).

    Raises
    ------
    MaterialError
        There is no ply.
    """
    thickness = _thicknesses(plies)
    faces = np.concatenate([[0.0], np.cumsum(thickness)]) - thickness.sum() / 2.0
    reduced = np.array([np.linalg.inv(ply.turned().compliance[np.ix_(_IN, _IN)]) for ply in plies])
    a, b, d = (np.tensordot(np.diff(faces**p) / p, reduced, axes=1) for p in (1, 2, 3))
    return PlateStiffness(A=a, B=b, D=d)


def homogenize_laminate(plies: Sequence[Ply]) -> Hooke:
    """Return the solid that deforms like the laminate under fields that vary little over one ply.

    Strains in the plane and stresses through the thickness are common to all plies; all the rest is
    averaged (N. J. Pagano, Exact moduli of anisotropic laminates, in Composite Materials 2, 1974).

    Raises
    ------
    MaterialError
        There is no ply.
    """
    thickness = _thicknesses(plies)
    share = thickness / thickness.sum()
    c = np.array([ply.turned().matrix for ply in plies])
    plane, out = c[:, _IN[:, None], _IN], c[:, _OUT[:, None], _OUT]
    coupling = c[:, _OUT[:, None], _IN]
    soft = np.linalg.inv(out)
    influence = soft @ coupling

    mean_out = np.linalg.inv(np.tensordot(share, soft, axes=1))
    mean_influence = np.tensordot(share, influence, axes=1)
    condensed = np.tensordot(share, plane - np.swapaxes(coupling, 1, 2) @ influence, axes=1)
    matrix = np.zeros((6, 6))
    matrix[np.ix_(_OUT, _OUT)] = mean_out
    matrix[np.ix_(_OUT, _IN)] = mean_out @ mean_influence
    matrix[np.ix_(_IN, _OUT)] = matrix[np.ix_(_OUT, _IN)].T
    matrix[np.ix_(_IN, _IN)] = condensed + mean_influence.T @ mean_out @ mean_influence
    return Hooke(matrix)


def _thicknesses(plies: Sequence[Ply]) -> Array:
    if not plies:
        raise MaterialError("laminate: at least one ply is needed")
    return np.array([ply.thickness_m for ply in plies])
