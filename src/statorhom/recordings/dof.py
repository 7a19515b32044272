"""Where and in which direction something was measured or excited."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

Vector = tuple[float, float, float]


@dataclass(frozen=True)
class Dof:
    """A measured degree of freedom.

    Attributes
    ----------
    node : int
        Number of the point.
    position : (x, y, z) or None
        Where it lies (m), machine axes; None where the file does not say.
    direction : (x, y, z) or None
        Unit vector of the positive direction, Cartesian; None where the file does not say.
    """

    node: int
    position: Vector | None = None
    direction: Vector | None = None

    @property
    def cylindrical_direction(self) -> Vector | None:
        """The direction's (radial, tangential, axial) components at the point; None where unknown."""
        if self.position is None or self.direction is None:
            return None
        x, y, z = self.direction
        angle = float(np.arctan2(self.position[1], self.position[0]))
        cos, sin = float(np.cos(angle)), float(np.sin(angle))
        return (x * cos + y * sin, y * cos - x * sin, z)

    @property
    def angle(self) -> float | None:
        """Angle of the point around the machine axis (rad), 0 … 2π; None where its position is unknown."""
        if self.position is None:
            return None
        return float(np.arctan2(self.position[1], self.position[0]) % (2 * np.pi))
