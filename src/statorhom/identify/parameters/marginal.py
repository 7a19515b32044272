"""Smooth map between a constant and a coordinate in which its prior is standard normal."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from statorhom.identify.parameters.bounds import Array
from statorhom.materials.typical_ranges import Z95

# distance from the median, in prior standard deviations, over which the two slopes blend
BLEND = 0.5


@dataclass(frozen=True, eq=False)
class Marginals:
    """Maps of several constants at once: t = m + a z + b (√(z² + c²) − c), value = t or exp t.

    The map is a hyperbola: its two ends are straight lines whose slopes fit the lower and the
    upper half of the 90 % range, so that median and both quantiles are met exactly, skewed ranges
    included, and least squares see no kink. With c = (1 − ρ)/2, ρ = |u − l|/(u + l), it rises
    monotonically whatever the skewness, because √(Z² + c²) − c > ρ Z.

    Parameters
    ----------
    centre, slope, skew, blend : array, shape (d,)
        m, a, b and c above.
    logarithmic : bool array, shape (d,)
        Whether t is the constant's natural logarithm.
    """

    centre: Array
    slope: Array
    skew: Array
    blend: Array
    logarithmic: np.ndarray

    @classmethod
    def from_ranges(cls, median: Array, low90: Array, high90: Array, logarithmic: np.ndarray) -> Marginals:
        """Fit the maps to medians and 90 % ranges (5 % and 95 % quantiles), each of shape (d,)."""
        centre, low, high = (_scaled(np.asarray(v, float), logarithmic) for v in (median, low90, high90))
        below, above = centre - low, high - centre
        rho = np.abs(above - below) / (above + below)
        blend = BLEND * (1.0 - rho)
        slope = (above + below) / (2.0 * Z95)
        skew = (above - below) / (2.0 * (np.hypot(Z95, blend) - blend))
        return cls(centre, slope, skew, blend, logarithmic)

    def values(self, z: Array) -> Array:
        """Return the constants at the coordinates `z`, shape (..., d)."""
        t = self.centre + self.slope * z + self.skew * (np.hypot(z, self.blend) - self.blend)
        return _unscaled(t, self.logarithmic)

    def derivatives(self, z: Array) -> Array:
        """Return d value / d z at `z`, shape (..., d)."""
        # a map that is blended to a kink (c -> 0) has no derivative at 0: its mean slope stands there
        radius = np.hypot(z, self.blend)
        direction = np.divide(z, radius, out=np.zeros_like(radius), where=radius > 0.0)
        rate = self.slope + self.skew * direction
        return np.where(self.logarithmic, rate * self.values(z), rate)

    def coordinates(self, values: Array) -> Array:
        """Return the coordinates of constants, shape (..., d); a logarithmic 0 or inf is infinite."""
        with np.errstate(divide="ignore"):
            t = _scaled(np.asarray(values, float), self.logarithmic) - self.centre
        finite = np.isfinite(t)
        return np.where(finite, self._solve(np.where(finite, t, 0.0)), t)

    def _solve(self, t: Array) -> Array:
        # (t + b c − a z)² = b² (z² + c²), the root on the rising branch
        shifted = t + self.skew * self.blend
        quadratic = (self.slope - self.skew) * (self.slope + self.skew)
        root = np.sqrt(shifted**2 + quadratic * self.blend**2)
        return (self.slope * shifted - self.skew * root) / quadratic


def _scaled(values: Array, logarithmic: np.ndarray) -> Array:
    return np.where(logarithmic, np.log(np.where(logarithmic, values, 1.0)), values)


def _unscaled(t: Array, logarithmic: np.ndarray) -> Array:
    return np.where(logarithmic, np.exp(np.where(logarithmic, t, 0.0)), t)
