"""The reduced basis of one harmonic in one cell of materials."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from statorhom.model.eigen import SHIFT
from statorhom.model.residual_norm import ResidualNorm

SPARE = 4  # Ritz values above the band that may serve as barriers


@dataclass(frozen=True)
class LocalBasis:
    """One harmonic in the reduced basis of a cell.

    Parameters
    ----------
    basis : (m, k) coordinates of the basis in the harmonic's space, of unit mass at the reference's densities.
    stiffness : (s, k, k) per unit weight of the material span's directions.
    mass : (regions, k, k) per unit density.
    residual : norm of residuals; its terms are the directions, then the regions.
    error : largest certified relative frequency error at the cell's training materials.
    """

    basis: np.ndarray
    stiffness: np.ndarray
    mass: np.ndarray
    residual: ResidualNorm
    error: float


def norm_shift(highest_hz: float) -> float:
    """σ of the norm in which the residuals of a band are measured (rad²/s²)."""
    return SHIFT * float((2 * np.pi * highest_hz) ** 2)
