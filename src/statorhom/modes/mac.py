"""Modal assurance criterion for complex shapes, single modes and doublets' planes alike.

Sources: Allemang & Brown (1982) for the MAC; for subspaces the cosines of the principal angles,
Björck & Golub (1973).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from statorhom.errors import IdentificationError

FloatArray = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]

_RANK_TOLERANCE = 1e-10


def mac(first: npt.ArrayLike, second: npt.ArrayLike) -> float:
    """MAC |aᴴb|² / (aᴴa · bᴴb) of two shapes, 0 … 1.

    Parameters
    ----------
    first, second : array_like, shape (points, …), equal
        Shapes, real or complex, at the same points; a point that is NaN in either is left out.

    Raises
    ------
    IdentificationError
        When the shapes differ in size or one does not move at the common points.
    """
    return subspace_mac(np.asarray(first).reshape(-1, 1), np.asarray(second).reshape(-1, 1))


def subspace_mac(first: npt.ArrayLike, second: npt.ArrayLike) -> float:
    """MAC of the spaces that two sets of shapes span: the mean squared cosine of their principal angles.

    One measured shape against the two of a simulated doublet gives the part of it that lies in the
    doublet's plane, whatever the doublet's orientation; two single shapes give the ordinary MAC.

    Parameters
    ----------
    first, second : array_like, shape (points, modes) or (points,)
        Shapes in columns; a point that is NaN in any column is left out.

    Raises
    ------
    IdentificationError
        When the numbers of points differ or a set does not move at the common points.
    """
    a, b = _columns(first), _columns(second)
    if len(a) != len(b):
        raise IdentificationError(f"shapes at {len(a)} and at {len(b)} points cannot be compared by MAC")
    common = np.isfinite(a).all(axis=1) & np.isfinite(b).all(axis=1)
    cosines = _basis(a[common]).conj().T @ _basis(b[common])
    return min(1.0, float(np.sum(np.abs(cosines) ** 2)) / min(cosines.shape))


def mac_matrix(measured: Sequence[npt.ArrayLike], simulated: Sequence[npt.ArrayLike]) -> FloatArray:
    """MAC of all measured with all simulated shapes.

    Parameters
    ----------
    measured, simulated : sequence of array_like, shape (points, modes) or (points,) each
        Shapes; a doublet is one entry of two columns.

    Returns
    -------
    ndarray, shape (measured, simulated)
    """
    values = [[subspace_mac(one, other) for other in simulated] for one in measured]
    return np.array(values, dtype=float).reshape(len(measured), len(simulated))


def _columns(shapes: npt.ArrayLike) -> ComplexArray:
    array = np.asarray(shapes, dtype=complex)
    return array.reshape(-1, 1) if array.ndim == 1 else array


def _basis(shapes: ComplexArray) -> ComplexArray:
    """Orthonormal basis of the columns' span; columns are brought to one size before their rank is judged."""
    sizes = np.abs(shapes).max(axis=0, initial=0.0)
    moving = shapes[:, sizes > 0.0] / sizes[sizes > 0.0]
    if moving.size == 0:
        raise IdentificationError("a mode shape does not move at any common point: MAC is not defined")
    left, singular, _ = np.linalg.svd(moving, full_matrices=False)
    return left[:, singular > _RANK_TOLERANCE * singular[0]]
