"""Between the box of constants that is searched and the cube in which designs and surfaces live."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from statorhom.identify.parameters.bounds import Array
from statorhom.identify.parameters.parameter_space import ParameterSpace
from statorhom.materials.typical_ranges import Z95

ON_FACE = 0.02  # of the cube's half edge: this close a point lies on its face


@dataclass(frozen=True)
class Cube:
    """The 90 % ranges of a space's free constants as the cube [−1, 1]^d.

    The ranges are those of the priors: typical ones, or what the study gives as `prior`. Moduli go by their
    logarithm there, in which frequencies are nearly straight.

    Parameters
    ----------
    space : of the search: what is known already is fixed in it.
    """

    space: ParameterSpace

    @property
    def dimension(self) -> int:
        """Number of coordinates d."""
        return self.space.dimension

    def internal(self, points: Array) -> Array:
        """Coordinates of the space (…, d) at points of the cube."""
        low, high = self._faces()
        return low + (np.asarray(points) + 1.0) / 2.0 * (high - low)

    def points(self, x: Array) -> Array:
        """Points of the cube (…, d), or beyond it, at coordinates of the space."""
        low, high = self._faces()
        return 2.0 * (np.asarray(x) - low) / (high - low) - 1.0

    def values(self, point: Array) -> dict[str, float]:
        """All constants at a point of the cube."""
        return self.space.values(self.internal(point))

    def on_face(self, point: Array) -> tuple[str, ...]:
        """Constants that lie at the end of their range, or beyond."""
        near = np.abs(np.asarray(point)) > 1.0 - ON_FACE
        return tuple(name for name, at in zip(self.space.coordinates, near, strict=True) if at)

    def _faces(self) -> tuple[Array, Array]:
        spread = Z95 * self.space.prior_sd
        clip = self.space.bounds.clip
        return clip(self.space.prior_mean - spread), clip(self.space.prior_mean + spread)
