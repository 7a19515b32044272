"""How well an effect explains with given parameters, the constants at their best.

Constants are many, and what they do is nearly in proportion: a step or two to first order finds the best of them. An
effect's parameters are few, and what they do is bent: over them the profile shows other valleys, and limits.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from statorhom.diagnose.fits.importance import Box
from statorhom.diagnose.fits.refit import Point, Refit, covariance_of
from statorhom.errors import StatorhomError

FloatArray = npt.NDArray[np.float64]

HALF_PERIOD = np.sqrt(3.0)  # of an angle, in its own coordinate (`statorhom.physics.parameter`)
TOLD = 1e-2  # information of a uniform coordinate below which nothing is told of it
STEPS = 4  # of the constants to where they are best
ENOUGH = 0.3  # of the objective that a step promises, below which it is known by that promise
HOPELESS = 25.0  # of the objective above the optimum: how much more it is does not matter
FURTHEST, LONGEST = 3.0, 1.5  # that constants follow the effect at once, and that they go in one step
SHORTER = 0.4  # of a step that leads up
PART = 0.1  # of what a step promises, that it has to keep


@dataclass(frozen=True, eq=False)
class Profile:
    """About an optimum, its pairing held.

    Parameters
    ----------
    optimum : the refit.
    places : of those of the effects' parameters that something is told of, among all coordinates.
    precision : (constants, constants) half the Hessian of the objective by the constants.
    slopes : (constants, places) how the best constants follow the parameters.
    """

    optimum: Refit
    places: Sequence[int]
    precision: FloatArray
    slopes: FloatArray

    @classmethod
    def of(cls, optimum: Refit) -> Profile:
        """About this one."""
        n, J, weights = optimum.hypothesis.constants, optimum.jacobian, optimum.hypothesis.prior_weights
        told = (weights > 0.0) | (np.sum(J**2, axis=0) > TOLD)
        places = [i for i in range(n, len(optimum.z)) if told[i]]
        precision = J[:, :n].T @ J[:, :n] + np.diag(weights[:n])
        slopes = -np.linalg.solve(precision, J[:, :n].T @ J[:, places])
        return cls(optimum, places, precision, np.asarray(slopes))

    @property
    def middle(self) -> FloatArray:
        """(places,) parameters at the optimum."""
        return self.optimum.z[self.places]

    @property
    def covariance(self) -> FloatArray:
        """(places, places) of the parameters, to first order."""
        both = covariance_of(self.optimum.jacobian, self.optimum.hypothesis.prior_weights)
        return np.asarray(both[np.ix_(self.places, self.places)])

    @property
    def is_normal(self) -> npt.NDArray[np.bool_]:
        """(places,) whether a parameter's prior is normal; otherwise it is uniform."""
        return np.asarray(self.optimum.hypothesis.prior_weights[self.places] > 0.0)

    @property
    def prior(self) -> Box:
        """Of the parameters, within their limits."""
        return Box(*self.limits(), self.is_normal)

    def limits(self) -> tuple[FloatArray, FloatArray]:
        """Of the parameters; an angle has those of a turn about the optimum."""
        low, high = (np.asarray(side[self.places]) for side in self.optimum.hypothesis.limits())
        turning = ~np.isfinite(low)
        low[turning], high[turning] = self.middle[turning] - HALF_PERIOD, self.middle[turning] + HALF_PERIOD
        return low, high

    def best(self, parameters: FloatArray) -> tuple[FloatArray, float] | None:
        """All coordinates with these parameters, and the objective there; None where no body has them."""
        here = self._point(self._followed(parameters))
        if here is None:
            return None
        for _ in range(STEPS):
            step, promised = self._step(here)
            if promised < ENOUGH or here.objective - promised > self.optimum.objective + HOPELESS:
                break
            better = self._stepped(here, step, PART * promised)
            if better is None:
                break
            here = better
        return here.z, here.objective - min(self._step(here)[1], ENOUGH)

    def log_likelihood(self, parameters: FloatArray) -> float:
        """ln of the objective's part of the evidence, without the prior of the parameters; -inf where no body is."""
        found = self.best(parameters)
        if found is None:
            return -np.inf
        return -0.5 * (found[1] - float(np.sum(np.asarray(parameters)[self.is_normal] ** 2)))

    def _followed(self, parameters: FloatArray) -> FloatArray:
        """Coordinates of these parameters, the constants where they promise to be best."""
        z, moved = self.optimum.z.copy(), parameters - self.middle
        z[self.places] = parameters
        z[: len(self.slopes)] += np.clip(self.slopes @ moved, -FURTHEST, FURTHEST)
        return np.clip(z, *self.optimum.hypothesis.limits())

    def _point(self, z: FloatArray) -> Point | None:
        try:
            point = Point.of(self.optimum.hypothesis, z)
        except (StatorhomError, KeyError):
            return None
        return point if len(point.residuals) == len(self.optimum.jacobian) else None

    def _step(self, here: Point) -> tuple[FloatArray, float]:
        """Of the constants to where they are best to first order, and what that gains of the objective."""
        n = len(self.precision)
        weights = self.optimum.hypothesis.prior_weights[:n]
        gradient = self.optimum.jacobian[:, :n].T @ here.residuals + weights * here.z[:n]
        step = -np.linalg.solve(self.precision, gradient)
        return np.asarray(step), float(-gradient @ step)

    def _stepped(self, here: Point, step: FloatArray, least: float) -> Point | None:
        """After a step, or after a part of it where all of it gains less than a least; None where that leads up."""
        limits = self.optimum.hypothesis.limits()
        for part, gain in ((1.0, least), (SHORTER, 0.0)):
            z = here.z.copy()
            z[: len(step)] += np.clip(part * step, -LONGEST, LONGEST)
            there = self._point(np.clip(z, *limits))
            if there is not None and there.objective < here.objective - gain:
                return there
        return None
