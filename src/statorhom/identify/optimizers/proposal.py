"""Random moves inside a box, with step lengths that follow the landscape."""

from __future__ import annotations

import numpy as np

from statorhom.identify.parameters.bounds import Array, Bounds

# shares of moves: along one coordinate, along all, and heavy-tailed jumps that leave a basin
SINGLE, ALL = 0.7, 0.2
# a step grows when accepted and shrinks when rejected; they balance at this rate of acceptance
TARGET_RATE = 0.4
GAIN = 0.35
SMALLEST_STEP = 1e-6


class Proposal:
    """Proposes neighbours; one step length per coordinate, adapted to its rate of acceptance.

    The idea of one step per coordinate is that of Corana, Marchesi, Martini and Ridella (ACM
    Trans. Math. Softw. 13, 1987): constants which the data pin down need steps a thousand times
    shorter than those they leave free.

    Parameters
    ----------
    bounds : Bounds
    rng : numpy Generator
        Drawn from by every move.
    """

    def __init__(self, bounds: Bounds, rng: np.random.Generator) -> None:
        self._bounds = bounds
        self._rng = rng
        self._largest = np.minimum(1.0, 0.5 * bounds.width)
        self.steps = self._largest.copy()
        self._moved: int | None = None

    def propose(self, x: Array) -> Array:
        """Return a new point of the box near `x`."""
        kind = self._rng.random()
        self._moved = None
        if kind < SINGLE:
            move = self._along_one()
        elif kind < SINGLE + ALL:
            move = self.steps * self._rng.standard_normal(x.size) / np.sqrt(x.size)
        else:
            move = self._jump(x.size)
        return self._bounds.reflect(x + move)

    def feedback(self, accepted: bool) -> None:
        """Adapt the step of the coordinate that moved last."""
        if self._moved is None:
            return
        factor = np.exp(GAIN * (float(accepted) - TARGET_RATE))
        step = self.steps[self._moved] * factor
        self.steps[self._moved] = np.clip(step, SMALLEST_STEP, self._largest[self._moved])
        self._moved = None

    def _along_one(self) -> Array:
        place = int(self._rng.integers(self.steps.size))
        self._moved = place
        move = np.zeros(self.steps.size)
        move[place] = self.steps[place] * self._rng.standard_normal()
        return move

    def _jump(self, size: int) -> Array:
        # the tails of a Cauchy distribution reach over the whole box from anywhere
        move = self._largest * self._rng.standard_cauchy(size)
        if self._rng.random() < 0.5:
            move *= np.arange(size) == self._rng.integers(size)
        return move
