"""A mode shape as measured: a complex displacement per node."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class ModeShape:
    """One mode of a test.

    Attributes
    ----------
    frequency_hz : float
        Undamped natural frequency.
    damping_ratio : float or None
        ζ; None where the file does not say.
    nodes : tuple of int
        Numbers of the points.
    displacement : complex array, shape (nodes, 3)
        Cartesian components (x, y, z); 0 where a component was not measured.
    """

    frequency_hz: float
    damping_ratio: float | None
    nodes: tuple[int, ...]
    displacement: np.ndarray

    def __post_init__(self) -> None:
        if self.displacement.shape != (len(self.nodes), 3):
            raise ValueError("a mode shape needs three components per node")
        self.displacement.setflags(write=False)
