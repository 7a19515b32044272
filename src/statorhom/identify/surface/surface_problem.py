"""A stage's problem with response surfaces in the place of the model."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import cast

import numpy as np

from statorhom.identify.inference.problem import Problem
from statorhom.identify.parameters.bounds import Array
from statorhom.identify.residuals.stage_problem import StageProblem
from statorhom.identify.surface.mode_surfaces import ModeSurfaces
from statorhom.model.convergence import ModeKey
from statorhom.model.reduced_stator import ReducedModes
from statorhom.model.stator_mode import StatorMode


@dataclass(frozen=True)
class SurfaceModes:
    """Modes of one evaluation."""

    modes: tuple[StatorMode, ...]


@dataclass(frozen=True, eq=False)
class SurfaceProblem(StageProblem):
    """Residuals from response surfaces; its space may have more coordinates than they know of.

    Parameters
    ----------
    surfaces : of the frequencies.
    """

    surfaces: ModeSurfaces = field(kw_only=True)

    def solve(self, x: Array) -> ReducedModes:
        """Modes of the surfaces at a point: all that pairing and residuals ask for."""
        return cast(ReducedModes, SurfaceModes(self.surfaces.modes(self.point(x))))

    def point(self, x: Array) -> Array:
        """Point of the cube, or beyond it, at which the constants are those of `x`."""
        if self.space is self.surfaces.cube.space:
            return self.surfaces.cube.points(x)
        return self.surfaces.cube.points(self.surfaces.cube.space.internal(self.space.values(x)))

    def data_jacobian(self, x: Array) -> Array:
        """Central differences with the pairing held: surfaces cost microseconds."""
        return Problem.data_jacobian(self.smooth_at(x), x)

    def objectives(self, points: Array, keys: Sequence[ModeKey | None]) -> Array:
        """|f − f_measured| / f_measured in percent, (n, m), at points of the cube with a pairing held.

        The seed's equation (12); a measured mode without a partner is as wrong everywhere.
        """
        f = self.surfaces.frequencies(points)
        errors = np.full((len(f), len(self.measured)), 100.0)
        for i, (measured, key) in enumerate(zip(self.measured, keys, strict=True)):
            if key in self.surfaces.keys:
                column = f[:, self.surfaces.keys.index(key)] * self.error.factor(key) * self.error.effect(key)
                errors[:, i] = 100.0 * np.abs(column / measured.frequency_hz - 1.0)
        return errors
