"""The reduced basis of one harmonic in one cell of materials."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from statorhom.model.eigen import SHIFT
from statorhom.model.residual_norm import ResidualNorm

SPARE = 2  # Ritz values above the band that may serve as barriers
BEYOND = 1  # modes above the band in every snapshot: the bounds need to know what comes next


@dataclass(frozen=True)
class RoomBasis:
    """One harmonic in as much of a cell's basis as a room of the cell needs.

    Parameters
    ----------
    turn : (K, k) its vectors in the cell's basis, of unit mass at the reference's densities.
    stiffness : (s, k, k) per unit weight of the material span's directions.
    mass : (regions, k, k) per unit density.
    residual : norm of residuals; its terms are the directions, then the regions.
    error : largest certified relative frequency error at the room's training materials.
    """

    turn: np.ndarray
    stiffness: np.ndarray
    mass: np.ndarray
    residual: ResidualNorm
    error: float

    @property
    def size(self) -> int:
        """k."""
        return int(self.turn.shape[1])

    @property
    def arrays(self) -> tuple[np.ndarray, ...]:
        """All arrays, those of the residual's norm last."""
        return self.turn, self.stiffness, self.mass, self.residual.factor, self.residual.scales


@dataclass(frozen=True)
class LocalBasis:
    """One harmonic in the reduced basis of a cell.

    Parameters
    ----------
    basis : (m, K) coordinates of the basis in the harmonic's space.
    rooms : what each room of the cell needs of it.
    """

    basis: np.ndarray
    rooms: tuple[RoomBasis, ...]

    @property
    def error(self) -> float:
        """Largest certified relative frequency error at the cell's training materials."""
        return max(room.error for room in self.rooms)

    @property
    def arrays(self) -> tuple[np.ndarray, ...]:
        """All arrays."""
        return self.basis, *(array for room in self.rooms for array in room.arrays)


def norm_shift(highest_hz: float) -> float:
    """σ of the norm in which the residuals of a band are measured (rad²/s²)."""
    return SHIFT * float((2 * np.pi * highest_hz) ** 2)
