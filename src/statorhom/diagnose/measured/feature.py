"""One thing that was measured against what is predicted of it, in standard deviations."""

from __future__ import annotations

from dataclasses import dataclass
from math import log, tanh

import numpy as np

from statorhom.model.convergence import ModeKey

LINEAR, KNEE = 8.0, 3.0  # residuals grow with their logarithm beyond: one outlier does not bend all constants
# Residuals of a kind that say no more. A cable or a cushion can double a loss factor, and is no physics of the stator;
# shapes of modes that come near each other mix at once, and what mixes is no guide to what causes it.
MOST = {"loss": 3.0, "lean": 4.0}
NUMBERED = -1  # in the place of n: a mode without a name, told by its row in the table
SINGLE = 50  # in the place of a rank, and above: a mode that is single though those of its order are doublets
LOST, LOST_UNNAMED = 10.0, 4.0  # residual of a mode of a table that has no partner


@dataclass(frozen=True)
class Silence:
    """One line where a doublet has two: not resolved, or the other one was missed.

    Parameters
    ----------
    split : predicted, relative.
    width : split that shows one line alone, a standard deviation.
    most : residual of a split that nobody overlooks: measurements leave lines out.
    parts : 1 where a split has a size alone, 2 where it has an angle too.
    """

    split: float
    width: float
    most: float
    parts: int

    def residual(self, more: np.ndarray | float = 0.0) -> np.ndarray:
        """In standard deviations, of the predicted split and another one (any shape) across it."""
        return self.most * np.tanh(np.hypot(self.split, more) / (self.width * self.most))


@dataclass(frozen=True)
class Feature:
    """One residual.

    Parameters
    ----------
    kind : "frequency", "split", "shift", "lean", "shape", "density", "loss", "level", "level_loss".
    test : of which test, empty for densities.
    key : of which mode.
    measured, predicted : ln f, relative split, relative shift, kg/m³, ln η, or the change of ln f or ln η from the
        lowest force level.
    sd : of their difference.
    lost : whether the model has no such mode: the residual is a penalty.
    rows : labels of the measured modes that it is of; empty where it is of none, or they are named by the key alone.
    chance : of the way in which modes are called by its name (`PredictedMode.called`), told with its frequency.
    silence : of a split of which a single line was measured.
    least : `sd` where the model is as exact as models are at best; 0 where that is nothing to tell.
    third : whether it is of a line beside a mode's own, which has no partner or this one, as constants go.
    """

    kind: str
    test: str
    key: ModeKey | None
    measured: float
    predicted: float
    sd: float
    lost: bool = False
    rows: tuple[str, ...] = ()
    silence: Silence | None = None
    chance: float = 1.0
    least: float = 0.0
    third: bool = False

    @property
    def residual(self) -> float:
        """In standard deviations, large ones held down."""
        raw, most = self.deviation, MOST.get(self.kind)
        return held_down(raw) if most is None else most * tanh(raw / most)

    @property
    def steepness(self) -> float:
        """Derivative of the residual by the misfit in standard deviations."""
        raw, most = self.deviation, MOST.get(self.kind)
        if most is not None:
            return 1.0 - tanh(raw / most) ** 2
        return KNEE / (KNEE + max(0.0, abs(raw) - LINEAR))

    @property
    def deviation(self) -> float:
        """The same as it is."""
        return (self.measured - self.predicted) / self.sd

    @property
    def doubt(self) -> float:
        """What a normal density loses because the model is not sure: ln of the standard deviation over the least one.

        Without it a model would explain a frequency by not knowing it.
        """
        return 0.0 if self.lost or self.least == 0.0 else max(0.0, log(self.sd / self.least))

    @property
    def stray(self) -> bool:
        """Whether it stands for a named mode that has no partner."""
        return self.lost and self.measured > LOST_UNNAMED

    @property
    def mode(self) -> tuple[int, ...] | None:
        """As files name it: (r, n), or the row of a mode without a name."""
        if self.key is None:
            return None
        return self.key[:1] if self.key[1] == NUMBERED else self.key[:2]

    @property
    def group(self) -> tuple[str, ModeKey | None]:
        """What is held out together: all features of one named mode of a test; no constants change it."""
        return self.test, None if self.third else self.key

    @property
    def observed(self) -> frozenset[tuple[str, str | ModeKey | None]]:
        """What was measured of it, whatever partner an explanation finds for that."""
        return frozenset((self.test, row) for row in self.rows) or frozenset([self.group])


def held_down(residual: float) -> float:
    """The residual itself up to `LINEAR`, then its logarithm."""
    size = abs(residual)
    if size <= LINEAR:
        return residual
    return float(np.sign(residual) * (LINEAR + KNEE * np.log1p((size - LINEAR) / KNEE)))
