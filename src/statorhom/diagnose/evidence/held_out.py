"""Errors on what explanations did not see, of the declared model and of one, and whether they tell which is better."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from statorhom.model.convergence import ModeKey

# Of the errors. A table has so few numbers that its misfit contradicts little: its predictions must be the better ones.
LEAST_FALL, OF_TABLES = 0.25, 0.35
LEAST_NOISE = 1e-3  # percent
ERRORS = 2.0  # standard errors that the fall must exceed
MOST = 0.9  # of the squared errors: what one mode is of them where a fit has lost it
WORSE = 1.5  # a group worsens when its error grows by this and beyond its noise

WHAT = "each mode of which the two say different things, predicted from fits that did not see it (six folds)"
OF_SHIFTS = (
    "pole shifts of each mode from plane to plane, predicted from fits that did not see it (six folds)"
)
Group = tuple[str, ModeKey | None]
# Of a group: the split of its lines, its pole shifts, or the rest, whose model is far less certain.
SHIFT, REST = "shift", "mode"
APART = ("split", SHIFT)


@dataclass(frozen=True)
class HeldOut:
    """Errors of the groups that were held out, in percent.

    Parameters
    ----------
    groups : test and mode; one whose lines are split or whose poles are shifted stands here once for each of these.
    before, after : of the declared model and of the explanation.
    noise : what the measurement, the mesh and the modes that were seen leave uncertain; errors weigh by it.
    what : one line for the report.
    least_fall : part by which errors fall at least where an explanation predicts better.
    of_lines : whether of the modes only one line of two was unseen.
    kinds : of what was held out of each group (`APART`, `REST`); empty where that is all the same.
    """

    groups: tuple[Group, ...]
    before: tuple[float, ...]
    after: tuple[float, ...]
    noise: tuple[float, ...]
    what: str = WHAT
    least_fall: float = LEAST_FALL
    of_lines: bool = False
    kinds: tuple[str, ...] = ()

    @property
    def informative(self) -> int:
        """Number of modes that the declared model misses by more than their noise explains."""
        rows = zip(self.groups, self.before, self.noise, strict=True)
        return len({group for group, before, noise in rows if before > ERRORS * noise})

    @property
    def before_rms(self) -> float:
        return self._weighted(self.before)

    @property
    def after_rms(self) -> float:
        return self._weighted(self.after)

    @property
    def share_left(self) -> float:
        """Part of the declared model's error that is left; 1 where that had none.

        A mode that fits lose without it, with the explanation as without, is most of either error and says nothing of
        which one is better.
        """
        before, after = self._in_noise(self.before), self._in_noise(self.after)
        if not self.groups or not before.any():
            return 1.0
        worst = int(np.argmax(after))
        lost = after[worst] ** 2 > MOST * float(after @ after) and after[worst] > before[worst] / 2
        told = np.arange(len(after)) != worst if lost else np.ones(len(after), dtype=bool)
        whole = float(np.linalg.norm(before[told]))
        return float(np.linalg.norm(after[told])) / whole if whole > 0.0 else 1.0

    def _weighted(self, errors: Sequence[float]) -> float:
        """Root mean square; what the modes that were seen do not tell counts for little."""
        weights = self._in_noise(np.ones(len(errors)))
        return float(np.linalg.norm(self._in_noise(errors)) / np.linalg.norm(weights)) if len(errors) else 0.0

    def _in_noise(self, errors: Sequence[float] | np.ndarray) -> np.ndarray:
        return np.array(errors) / np.maximum(np.array(self.noise), LEAST_NOISE)

    @property
    def contradicts(self) -> bool:
        """Whether what was unseen is predicted no better, and worse than noise and what was seen allow.

        Which of two errors is the smaller one says nothing where the larger is no more than noise.
        """
        within_noise = bool(self.groups) and _rms(self._in_noise(self.after)) <= 1.0
        return self.after_rms >= self.before_rms and not within_noise

    @property
    def improves(self) -> bool:
        """Whether the error falls by enough, by chance or not."""
        return bool(self.groups) and self.after_rms <= (1 - self.least_fall) * self.before_rms

    @property
    def falls(self) -> bool:
        """Whether the error falls by enough, and by more than chance."""
        if not self.groups:
            return False
        # logarithms: one large error is not all that counts; nothing is smaller than its noise
        ratio = [
            np.log(max(b, n) / max(a, n)) for b, a, n in zip(self.before, self.after, self.noise, strict=True)
        ]
        mean, least = float(np.mean(ratio)), 1 - self.least_fall
        if self.after_rms > least * self.before_rms and np.exp(-mean) > least:
            return False
        spread = float(np.std(ratio, ddof=1)) / np.sqrt(len(ratio)) if len(ratio) > 1 else np.inf
        return mean > ERRORS * spread or self._by_chi2

    @property
    def _by_chi2(self) -> bool:
        """The fall of the squared errors in units of noise, against its own standard error."""
        before, after = (float(np.sum(self._in_noise(v) ** 2)) for v in (self.before, self.after))
        return before - after > ERRORS * float(np.sqrt(2 * len(self.groups) + 4 * after))

    @property
    def of_shifts(self) -> HeldOut:
        """Pole shifts alone, which nothing but a sensor's mass makes and the mesh does not blur."""
        own = [i for i, kind in enumerate(self.kinds) if kind == SHIFT]
        before, after, noise = (
            tuple(values[i] for i in own) for values in (self.before, self.after, self.noise)
        )
        groups = tuple(self.groups[i] for i in own)
        return HeldOut(groups, before, after, noise, OF_SHIFTS, self.least_fall, kinds=(SHIFT,) * len(own))

    @property
    def worsens(self) -> bool:
        """Whether a test's error grows beyond its noise."""
        tests = np.array([test for test, _ in self.groups])
        for test in set(tests.tolist()):
            before, after = (_rms(self._in_noise(v)[tests == test]) for v in (self.before, self.after))
            if after > WORSE * max(before, 1.0):
                return True
        return False


def _rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(np.square(values))))
