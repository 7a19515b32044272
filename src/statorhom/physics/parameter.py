"""A constant of an effect: what is expected of it before any measurement, and what it cannot pass."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from statorhom.materials.typical_ranges import Z95


@dataclass(frozen=True)
class EffectParameter:
    """One constant of an effect, in the unit that its name ends with.

    Parameters
    ----------
    name : as formats.md names it; `angle_rad` and `z_m` are places.
    low90, high90 : 5 % and 95 % quantile of the prior.
    lower, upper : physical limits; a fit that ends on one names nothing.
    scale : whether the prior is normal in the logarithm or in the value; "angle" and "place" are uniform between
        the limits, an angle with the period `upper - lower`.
    starts : values from which a refit sets out; the first one is where signatures are taken.
    absent : value without the effect, None where only a limit of the scale is.
    usual : of a detail that is carried as uncertainty and is no magnitude: what a study that leaves it open means.
    last : whether refits of its effect begin with it as usual: one that has all free at once goes astray.
    negligible : distance from `absent` within which nothing is missing: a tolerance of what was typed.
    """

    name: str
    low90: float
    high90: float
    lower: float
    upper: float
    scale: Literal["log", "linear", "angle", "place"] = "linear"
    starts: tuple[float, ...] = ()
    absent: float | None = 0.0
    usual: float | None = None
    negligible: float = 0.0
    last: bool = False

    @property
    def located(self) -> bool:
        """Whether it says where."""
        return self.scale in ("angle", "place")

    @property
    def absence(self) -> float | None:
        """The coordinate without the effect; None of a place, and where its scale has no such value."""
        if self.located or self.absent is None or (self.scale == "log" and self.absent <= 0.0):
            return None
        return self.internal(self.absent)

    def internal(self, value: float) -> float:
        """The coordinate of a value: deviation from the prior's middle in standard deviations."""
        middle, spread = self._normal
        return (self._onto(value) - middle) / spread

    def value(self, internal: float) -> float:
        """The value at a coordinate; an angle is brought into its period, all else into its limits."""
        middle, spread = self._normal
        raw = middle + spread * internal
        if self.scale == "angle":
            return self.lower + (raw - self.lower) % (self.upper - self.lower)
        found = float(np.exp(np.clip(raw, -700.0, 700.0))) if self.scale == "log" else raw
        return float(np.clip(found, self.lower, self.upper))

    @property
    def _normal(self) -> tuple[float, float]:
        if self.located:
            return 0.5 * (self.lower + self.upper), (self.upper - self.lower) / np.sqrt(12)
        low, high = self._onto(self.low90), self._onto(self.high90)
        return 0.5 * (low + high), (high - low) / (2 * Z95)

    def _onto(self, value: float) -> float:
        return float(np.log(value)) if self.scale == "log" else float(value)


def angle(period: float = 2 * np.pi) -> EffectParameter:
    """A place around the stator (rad)."""
    return EffectParameter("angle_rad", 0.0, period, 0.0, period, "angle")


def height(length: float) -> EffectParameter:
    """A place along the core of a length (m)."""
    return EffectParameter("z_m", 0.0, length, 0.0, length, "place")
