"""A measured shape at the sensors of a plate, a beam or a wing."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from statorhom.modes.measured_shape import MeasuredShape


@dataclass(frozen=True)
class PointShape:
    """Complex motion of sensors that lie around no axis.

    Attributes
    ----------
    positions_m : ndarray, shape (sensors, 3)
        In the frame of the geometry file (m).
    directions : ndarray, shape (sensors, 3)
        Unit vectors.
    values : ndarray of complex, shape (sensors,)
        Motion along them, in any unit.
    """

    positions_m: npt.NDArray[np.float64]
    directions: npt.NDArray[np.float64]
    values: npt.NDArray[np.complex128]

    def __post_init__(self) -> None:
        for array in (self.positions_m, self.directions, self.values):
            array.setflags(write=False)


#: The shapes of one test, by the rows of its table.
TestShapes = tuple[MeasuredShape, ...] | tuple[PointShape, ...]
