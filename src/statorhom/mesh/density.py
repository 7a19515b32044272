"""How finely a step is meshed: number of cells along every named division, and their grading."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from statorhom.study.frozen_map import FrozenMap

# cells of the coarsest mesh that represents every mode of a stator's usual band
COARSEST = {
    "tooth": 1,  # half a tooth, tangentially
    "slot": 1,  # half a slot, tangentially
    "shoulder": 1,
    "opening": 1,
    "tip": 1,  # tooth tip, radially
    "round_side": 2,  # a round slot bottom, an eighth of a turn each: one cell would miss 0.2 % of its volume
    "round_crown": 2,
    "radial": 2,  # tooth and slot, radially
    "yoke": 2,
    "frame": 1,
    "shield": 3,
    "core": 3,  # axially
    "overhang": 2,
    "frame_end": 2,
    "shield_axial": 1,
}
# Refining by 1.5 and by 2 gives similar meshes, as extrapolation needs, only where the numbers are even; the
# slot's opening and the tooth tip, which hardly bend, may be exceptions.
GRADED = COARSEST | {
    "tooth": 2,
    "slot": 2,
    "shoulder": 2,
    "radial": 4,
    "yoke": 4,
    "frame": 2,
    "shield": 2,
    "core": 4,
}
ROUNDING = 1e-9


@dataclass(frozen=True)
class MeshDensity:
    """Cells along every division.

    Parameters
    ----------
    cells : division → number of cells.
    grading : how many times longer cells are at the far end of a graded edge than at the tooth root where it
        begins, in the limit of many cells (1: uniform).
    end_grading : how many times longer cells are in the middle of the core than at its ends, in the limit of
        many cells (1: uniform); a core that a frame's end cuts has uniform ones.
    widest : largest angle (rad) on the back of the core of an unrefined cell, or None; stators of few slots
        get more cells where `cells` would be too wide.
    longest : the same for the axial length, in outer radii of the core.
    factor : refinement; multiplies all numbers of cells.
    bare : division → number of cells where the slots are empty, and nothing holds the teeth.
    """

    cells: Mapping[str, int]
    grading: float = 1.0
    end_grading: float = 1.0
    widest: float | None = None
    longest: float | None = None
    factor: float = 1.0
    bare: Mapping[str, int] = FrozenMap({})

    def __post_init__(self) -> None:
        object.__setattr__(self, "cells", FrozenMap(self.cells))
        object.__setattr__(self, "bare", FrozenMap(self.bare))

    def refined(self, factor: float) -> MeshDensity:
        """The same mesh with every number of cells multiplied by `factor` (rounded, at least as many)."""
        return replace(self, factor=self.factor * factor)

    def of_empty_slots(self) -> MeshDensity:
        """The mesh of a step whose slots are empty."""
        return replace(self, cells={**self.cells, **self.bare})

    def across(self, division: str, angle: float = 0.0) -> int:
        """Cells along a division of the section that takes `angle` (rad) of the back of the core."""
        return self._count(division, angle, self.widest)

    def along(self, division: str, length: float = 0.0, share: float = 1.0) -> int:
        """Cells along `share` of an axial division of `length` outer radii."""
        return max(1, _rounded(share * self._count(division, length, self.longest)))

    def progression(self, cells: int) -> float:
        """Ratio of neighbouring cells' lengths along a graded edge, counted from its dense end."""
        return float(self.grading ** (1 / cells)) if cells > 1 else 1.0

    def levels(self, cells: int) -> np.ndarray:
        """Ends of the cells along the core, as shares of its length."""
        share = np.linspace(0.0, 1.0, cells + 1)
        if self.end_grading == 1.0:
            return share
        near = 0.5 - np.abs(share - 0.5)
        grown = (self.end_grading ** (2 * near) - 1) / (self.end_grading - 1) / 2
        return np.where(share <= 0.5, grown, 1 - grown)

    def _count(self, division: str, size: float, largest: float | None) -> int:
        least = self.cells[division]
        if largest is not None:
            least *= max(1, math.ceil(size / (least * largest) - ROUNDING))
        return max(least, _rounded(least * self.factor))


def uniform(factor: int = 1) -> MeshDensity:
    """Equal cells: what a user of a commercial program would draw without further thought."""
    return MeshDensity(COARSEST).refined(factor)


def graded(factor: float = 1.0, **cells: int) -> MeshDensity:
    """Cells shrink towards the tooth roots and the core's ends: uniform meshes converge slowly there.

    At the roots the re-entrant corners make strains singular, at the ends the lamination's lateral contraction
    becomes free within a fraction of the tooth's height.

    Parameters
    ----------
    factor : refinement.
    **cells : numbers of cells of divisions that shall differ from the usual ones.
    """
    density = MeshDensity(
        GRADED | cells, grading=20.0, end_grading=10.0, widest=math.radians(7.5), longest=1.0
    )
    return density.refined(factor)


def _rounded(cells: float) -> int:
    return math.floor(cells + 0.5)
