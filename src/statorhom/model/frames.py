"""Local axes of displacement components and materials: where axis 1 points, as an angle about z."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

# positions (…, 3) in m → angle (…) of axis 1 from +x towards +y (rad); axis 3 is z everywhere
Frame = Callable[[np.ndarray], np.ndarray]


def cylindrical(positions: np.ndarray) -> np.ndarray:
    """Axes r, θ, z: a stator's."""
    return np.arctan2(positions[..., 1], positions[..., 0])


def cartesian(positions: np.ndarray) -> np.ndarray:
    """Axes x, y, z: a plate's or a beam's."""
    return np.zeros(positions.shape[:-1])


FRAMES: Mapping[str, Frame] = {"cylindrical": cylindrical, "cartesian": cartesian}
