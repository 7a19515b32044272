"""The norm of a residual in a few products: r = Σ w_a K_a Φ x - λ Σ d_b M_b Φ x seen through A⁻¹ of a reference.

All residuals of a basis lie in the space of its images K_aΦ, M_bΦ. The Gram matrix of these images in the norm of
A⁻¹ is computed once and written as FᵀF with as many rows as matter; what is cut off is kept as a bound, so that
the norm is never too small. Single precision is enough: the eigenvalue's error is the norm's square, and the squares
of what rounding leaves, 1e-14 of the largest image, are far below any error worth certifying.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import lapack


@dataclass(frozen=True)
class ResidualNorm:
    """Factor of the Gram matrix of a basis's images.

    Parameters
    ----------
    factor : (t, p, k) single precision: an image of unit weight in p orthonormal coordinates, for t terms and k
        basis vectors.
    scales : (t,) typical weights.
    dropped : bound of what the coordinates leave out of ‖r‖², as a part of the energy xᵀAx at the reference, per
        square of weights over their scales.
    """

    factor: np.ndarray
    scales: np.ndarray
    dropped: float


def residual_norm(
    gram: np.ndarray, scales: np.ndarray, energies: np.ndarray, negligible: float
) -> ResidualNorm:
    """Factorize a Gram matrix.

    Parameters
    ----------
    gram : (t, k, t, k) inner products of the images per unit weight.
    scales : (t,) typical weights.
    energies : (k,) xᵀAx of the basis vectors, which must be orthogonal in it.
    negligible : part of the energy that ‖r‖² need not resolve.
    """
    t, k = gram.shape[:2]
    size = t * k
    unit = (scales[:, None] / np.sqrt(energies)).ravel()
    square = gram.reshape(size, size)
    scaled = (square + square.T) / 2 * unit[:, None] * unit
    # Cholesky with pivots stops where the largest remaining diagonal is small; the remainder's trace bounds it
    triangle, pivots, rank, _ = lapack.dpstrf(scaled, tol=negligible / (t * size))
    rows = np.zeros((rank, size))
    rows[:, pivots - 1] = np.triu(triangle)[:rank]
    trace = float(np.trace(scaled))
    # a product of n numbers in single precision is off by n roundings at most
    rounding = (size * 2.0**-24) ** 2 * trace
    dropped = max(trace - float(np.sum(rows**2)), 0.0) + rounding
    factor = (rows / unit).reshape(rank, t, k).transpose(1, 0, 2)
    return ResidualNorm(np.ascontiguousarray(factor, np.float32), scales, dropped)


def squared_norms(
    elastic: np.ndarray, inertial: np.ndarray, rest: np.ndarray, values: np.ndarray, vectors: np.ndarray
) -> np.ndarray:
    """Upper bounds of ‖r‖² of Ritz pairs.

    Parameters
    ----------
    elastic, inertial : (…, p, k) factor weighted with the stiffnesses and with the densities.
    rest : (…, j) what the factor leaves out.
    values, vectors : (…, j) and (…, k, j) Ritz pairs.
    """
    narrow = vectors.astype(np.float32)
    r = elastic @ narrow - (inertial @ narrow) * values[..., None, :].astype(np.float32)
    # (|a| + |b|)² ≤ (1 + s) a² + (1 + 1/s) b² with s = 1/10
    return np.asarray(1.1 * np.einsum("...pj,...pj->...j", r, r) + 11.0 * rest)
