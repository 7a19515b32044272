"""What breaks a stator's symmetry, as the solver sees it: springs and masses at points, pieces changed copy by copy."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from statorhom.model.broken.pieces import Pieces
from statorhom.model.surface import SurfacePoints


@dataclass(frozen=True, eq=False)
class Attachment:
    """Springs to the ground and masses on a few motions of points.

    Parameters
    ----------
    points : of the stator.
    rows : (a, 3 p) motions as combinations of the points' displacements (u_r, u_θ, u_z).
    stiffness : (a, a) springs between the motions and the ground (N/m for displacements), semidefinite.
    mass : (a, a) of what moves along (kg for displacements), semidefinite.
    """

    points: SurfacePoints
    rows: np.ndarray
    stiffness: np.ndarray
    mass: np.ndarray

    def __post_init__(self) -> None:
        for array in (self.rows, self.stiffness, self.mass):
            array.setflags(write=False)

    @cached_property
    def place(self) -> bytes:
        """The same for all that act on the same motions of the same mesh, however stiff or heavy."""
        matrix, points = self.points.matrix, self.points
        parts = (matrix.indptr, matrix.indices, matrix.data, points.pitch, points.mirrored, self.rows)
        return b"".join(part.tobytes() for part in parts)


@dataclass(frozen=True, eq=False)
class PieceChange:
    """Pieces of the half pitch, each added to every copy with a weight of its own.

    Parameters
    ----------
    stiffness, mass : what a weight of one adds to K and M; None for nothing.
    weights : (e, 2 N) per piece and half pitch: 2 k from the centre of tooth k to the next slot, 2 k + 1 its
        mirror image.
    """

    stiffness: Pieces | None
    mass: Pieces | None
    weights: np.ndarray

    def __post_init__(self) -> None:
        self.weights.setflags(write=False)


Change = Attachment | PieceChange
