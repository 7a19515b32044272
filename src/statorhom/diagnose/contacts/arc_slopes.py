"""How modes beside an arc follow the materials, told once it is asked for.

Searches score thousands of windings by their frequencies alone, and a slope takes as long as a mode.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from typing import Protocol

import numpy as np


class Slope(Protocol):
    """d ln f by the Hooke entries and the density of all regions, one after the other."""

    @property
    def vector(self) -> np.ndarray: ...


@dataclass(frozen=True, eq=False)
class KnownSlope:
    """One that is known, (10 regions,)."""

    vector: np.ndarray


@dataclass(frozen=True, eq=False)
class LateSlope:
    """One that is told by `tell` when it is asked for."""

    tell: Callable[[], np.ndarray]

    @cached_property
    def vector(self) -> np.ndarray:
        return self.tell()


def mean_slope(parts: Sequence[tuple[float, Slope]]) -> LateSlope:
    """Of weights and slopes."""
    return LateSlope(partial(_mean, tuple(parts)))


def _mean(parts: Sequence[tuple[float, Slope]]) -> np.ndarray:
    return np.asarray(np.mean([weight * slope.vector for weight, slope in parts], axis=0))
