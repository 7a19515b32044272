"""Poly-reference least-squares complex frequency estimator in overlapping bands, over many model orders.

H(ω) = B(ω) A(ω)⁻¹ with matrix polynomials in z = exp(iπ(ω − ω_a)/(ω_b − ω_a)), complex coefficients, so only
positive frequencies appear; the denominator follows from reduced normal equations and its roots are the
poles. Source: Peeters, Van der Auweraer, Guillaume & Leuridan, "The PolyMAX frequency-domain method",
Shock and Vibration 11 (2004).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.linalg import eig

from statorhom.extraction.point_grid import PointGrid

FloatArray = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]

_REDUNDANCY = 1e-12  # ridge of an output's normal matrix, relative to its diagonal


@dataclass(frozen=True)
class PlscfPoles:
    """Poles of one model order in one band.

    Attributes
    ----------
    order : int
        Degree of the denominator.
    squared : complex array, shape (poles,)
        Poles in the plane of ω²: ω_r²(1 + iη_r) ((rad/s)²).
    participation : complex array, shape (poles, references)
        Unit vectors.
    """

    order: int
    squared: ComplexArray
    participation: ComplexArray


def plscf(grid: PointGrid, sd: FloatArray, lines: slice, highest_order: int) -> list[PlscfPoles]:
    """Poles inside a band for all orders from 2 up.

    Parameters
    ----------
    grid : PointGrid
    sd : array, shape (points, references, lines)
        Noise of the receptances, the inverse weight.
    lines : slice
        The band.
    highest_order : int
        Of the denominator.
    """
    omega = grid.omega[lines]
    span = float(omega[-1] - omega[0])
    z = np.exp(1j * np.pi * np.outer((omega - omega[0]) / span, np.arange(highest_order + 1)))
    normal = _reduced_normal_matrix(grid, sd, lines, z)
    result = []
    for order in range(2, highest_order + 1):
        roots, vectors = _roots(normal, order, len(grid.references))
        with np.errstate(divide="ignore", invalid="ignore"):
            pole = omega[0] + np.log(roots) * span / (1j * np.pi)
        squared = pole**2
        inside = (pole.real > omega[0]) & (pole.real < omega[-1]) & (squared.imag > 0) & np.isfinite(pole)
        result.append(PlscfPoles(order, squared[inside], vectors[inside]))
    return result


def _reduced_normal_matrix(grid: PointGrid, sd: FloatArray, lines: slice, z: ComplexArray) -> ComplexArray:
    """Σ over points of T − SᴴR⁻¹S, shape (orders, references, orders, references)."""
    count, references = z.shape[1], len(grid.references)
    total = np.zeros((count, references, count, references), dtype=complex)
    scale = float(np.median(sd))
    for values, deviations, known in zip(
        grid.receptance[..., lines], sd[..., lines], grid.measured[..., lines], strict=True
    ):
        # one weight per line for all references: the right fraction mixes them
        weight = np.where(known.all(axis=0), scale / deviations.max(axis=0), 0.0)
        x = z * weight[:, None]
        y = values[:, :, None] * x  # (references, lines, orders)
        r = x.conj().T @ x
        r[np.diag_indices(count)] *= 1 + _REDUNDANCY
        s = x.conj().T @ np.concatenate(list(y), axis=1)
        flat = np.concatenate(list(y), axis=1)
        reduced = flat.conj().T @ flat - s.conj().T @ np.linalg.solve(r, s)
        total += reduced.reshape(references, count, references, count).transpose(1, 0, 3, 2)
    return total


def _roots(normal: ComplexArray, order: int, references: int) -> tuple[ComplexArray, ComplexArray]:
    """Roots of the denominator and its null vectors there, with the lowest coefficient set to the identity."""
    size = (order + 1) * references
    matrix = normal[: order + 1, :, : order + 1, :].reshape(size, size)
    # A = Σ_j α_j z^j with α_0 = 1: physical poles are stable then, computational ones are not
    unknown = matrix[references:, references:]
    right = -matrix[references:, :references]
    alpha = np.concatenate([np.eye(references), np.linalg.lstsq(unknown, right, rcond=None)[0]])
    blocks = alpha.reshape(order + 1, references, references)
    first = np.zeros((order * references, order * references), dtype=complex)
    second = np.eye(order * references, dtype=complex)
    first[:-references, references:] = np.eye((order - 1) * references)
    for j in range(order):
        first[-references:, j * references : (j + 1) * references] = -blocks[j]
    second[-references:, -references:] = blocks[order]
    roots, vectors = eig(first, second)
    part = vectors[:references].T
    part = part / np.maximum(np.linalg.norm(part, axis=1, keepdims=True), np.finfo(float).tiny)
    return np.where(np.isfinite(roots) & (roots != 0), roots, np.nan), part
