"""Plates and beams: rectangular blocks of one material."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True)
class BlockGeometry:
    """A block that spans 0 … length along x, 0 … width along y and 0 … height along z.

    Parameters
    ----------
    region : name of its region.
    size : length, width and height (m).
    source : the geometry file, for messages.
    """

    region: str
    size: tuple[float, float, float]
    source: str

    def step(self, kinds: tuple[str, ...]) -> BlockGeometry:  # noqa: ARG002
        """What is tested; a block has no steps of fabrication."""
        return self

    @property
    def regions(self) -> tuple[str, ...]:
        """Its one region."""
        return (self.region,)

    def exact_volumes(self) -> Mapping[str, float]:
        """Volume of the region (m³)."""
        return {self.region: math.prod(self.size)}
