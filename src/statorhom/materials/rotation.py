"""Rotation of Hooke matrices in Voigt notation (order 11, 22, 33, 23, 13, 12, engineering shear strains)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]

# tensor indices (i, j) of the six Voigt components
_FIRST = np.array([0, 1, 2, 1, 0, 0])
_SECOND = np.array([0, 1, 2, 2, 2, 1])
# a shear stress stands twice in the tensor, a normal stress once
_BOTH_SHEARS = np.array([0.0, 0.0, 0.0, 1.0, 1.0, 1.0])


def cylinder_axes(theta: ArrayLike) -> Array:
    """Rotation from the axes r, θ, z at an angle to x, y, z.

    Parameters
    ----------
    theta : array_like, shape (...)
        Angle in radians, counted from +x towards +y.

    Returns
    -------
    ndarray, shape (..., 3, 3)
        Its columns are e_r, e_θ and e_z in Cartesian components.
    """
    angle = np.asarray(theta, dtype=float)
    axes = np.zeros((*angle.shape, 3, 3))
    axes[..., 0, 0] = axes[..., 1, 1] = np.cos(angle)
    axes[..., 1, 0] = np.sin(angle)
    axes[..., 0, 1] = -axes[..., 1, 0]
    axes[..., 2, 2] = 1.0
    return axes


def stress_rotation(rotation: ArrayLike) -> Array:
    """Bond's matrix N of a rotation R: the Voigt stresses in the new axes are N σ.

    From σ'_ij = R_ia R_jb σ_ab, the symmetric off-diagonal pairs taken together (B. A. Auld, Acoustic
    Fields and Waves in Solids, 1973, section 3.D).  A Hooke matrix turns as C' = N C Nᵀ.

    Parameters
    ----------
    rotation : array_like, shape (..., 3, 3)
        Its columns are the material's axes in components of the new axes.

    Returns
    -------
    ndarray, shape (..., 6, 6)
    """
    axes = np.asarray(rotation, dtype=float)
    i, j = _FIRST[:, None], _SECOND[:, None]
    a, b = _FIRST[None, :], _SECOND[None, :]
    return axes[..., i, a] * axes[..., j, b] + _BOTH_SHEARS * axes[..., i, b] * axes[..., j, a]


def rotate(matrix: ArrayLike, rotation: ArrayLike) -> Array:
    """Stiffness matrix C' = N C Nᵀ of a turned material.

    Parameters
    ----------
    matrix : array_like, shape (..., 6, 6)
        In the material's axes; need not be positive definite, so that the parts of an affine
        decomposition can be turned one by one.
    rotation : array_like, shape (..., 3, 3)
        Its columns are the material's axes in components of the new axes; leading axes broadcast.

    Returns
    -------
    ndarray, shape (..., 6, 6)
    """
    bond = stress_rotation(rotation)
    turned: Array = bond @ np.asarray(matrix, dtype=float) @ np.swapaxes(bond, -1, -2)
    return turned
