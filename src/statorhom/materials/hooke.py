"""The Hooke matrix of a material as an immutable object."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from statorhom.errors import MaterialError
from statorhom.materials.rotation import Array, cylinder_axes, rotate

_SYMMETRY_TOLERANCE = 1e-9
_ROTATION_TOLERANCE = 1e-9


@dataclass(frozen=True, eq=False)
class Hooke:
    """Stiffness matrix C of σ = C ε in Voigt notation.

    The order is 11, 22, 33, 23, 13, 12 with engineering shear strains; in cylindrical axes 1 = r,
    2 = θ, 3 = z.

    Parameters
    ----------
    matrix : array_like, shape (6, 6)
        Symmetric, in Pa. It is copied and set read-only.

    Raises
    ------
    MaterialError
        The matrix is not 6 × 6, not finite or not symmetric. Positive definiteness is asked for
        separately, by `check_positive_definite`.
    """

    matrix: Array

    def __post_init__(self) -> None:
        matrix = np.array(self.matrix, dtype=float)
        if matrix.shape != (6, 6):
            raise MaterialError(f"Hooke matrix: needs 6 × 6 entries, has the shape {matrix.shape}")
        if not np.isfinite(matrix).all():
            raise MaterialError("Hooke matrix: every entry must be a finite number")
        if (matrix != matrix.T).any():
            matrix = _symmetrized(matrix)
        matrix.flags.writeable = False
        object.__setattr__(self, "matrix", matrix)

    @property
    def compliance(self) -> Array:
        """Compliance matrix S = C⁻¹ in 1/Pa, shape (6, 6), read-only.

        Raises
        ------
        MaterialError
            The matrix is singular.
        """
        try:
            compliance: Array = np.linalg.inv(self.matrix).astype(float)
        except np.linalg.LinAlgError:
            raise MaterialError("Hooke matrix: is singular, so it has no compliance") from None
        compliance.flags.writeable = False
        return compliance

    def check_positive_definite(self, name: str = "Hooke matrix") -> None:
        """Refuse a material that would give energy away when it is deformed.

        Parameters
        ----------
        name : str
            What the message calls the material.

        Raises
        ------
        MaterialError
            The smallest eigenvalue is not positive; the message says which.
        """
        eigenvalues = np.linalg.eigvalsh(self.matrix)
        if eigenvalues[0] <= 0.0:
            raise MaterialError(
                f"{name}: must be positive definite, its smallest eigenvalue is {eigenvalues[0]:.4g} Pa"
            )

    def rotated(self, rotation: ArrayLike) -> Hooke:
        """Return the same material seen from other axes.

        Parameters
        ----------
        rotation : array_like, shape (3, 3)
            Its columns are the material's axes in components of the new axes.

        Raises
        ------
        MaterialError
            The matrix is not orthogonal.
        """
        axes = np.asarray(rotation, dtype=float)
        if axes.shape != (3, 3) or np.abs(axes @ axes.T - np.eye(3)).max() > _ROTATION_TOLERANCE:
            raise MaterialError("rotation of a Hooke matrix: needs an orthogonal 3 × 3 matrix")
        return Hooke(rotate(self.matrix, axes))

    def cylindrical_to_cartesian(self, theta: float) -> Hooke:
        """Return the matrix in x, y, z of a material given in r, θ, z, at the angle theta (rad).

        Many angles at once: `statorhom.materials.rotation.rotate` with `cylinder_axes`.
        """
        return self.rotated(cylinder_axes(theta))


def _symmetrized(matrix: Array) -> Array:
    """The mean of a matrix and its transpose, which differ by no more than rounding."""
    if np.abs(matrix - matrix.T).max() > _SYMMETRY_TOLERANCE * np.abs(matrix).max():
        raise MaterialError("Hooke matrix: must be symmetric, C_ij = C_ji, as an elastic energy exists")
    return (matrix + matrix.T) / 2.0
