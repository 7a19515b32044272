"""Errors on modes that an explanation did not see: constants and effect are fitted to the other modes only."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from typing_extensions import TypeVar

from statorhom.diagnose.any_hypothesis import AnyHypothesis
from statorhom.diagnose.explanations import Explanation
from statorhom.diagnose.features import Feature
from statorhom.diagnose.refit import Refit, refit
from statorhom.errors import StatorhomError
from statorhom.model.convergence import ModeKey

_H = TypeVar("_H", bound=AnyHypothesis)

FOLDS = 3
LEAST_FALL = 0.25
ERRORS = 2.0  # standard errors that the fall must exceed
WORSE = 1.5  # a group worsens when its error grows by this and beyond its noise
# of features other than frequencies, in terms of a frequency: split of λ, shift of a pole, level, a density's error
WEIGHT = {
    "frequency": 1.0,
    "split": 0.25,
    "shift": 1.0,
    "level": 1.0,
    "level_loss": 0.005,
    "density": 0.5,
}

Group = tuple[str, ModeKey | None]
WEIGHED: Group = ("", None)  # what is known of the densities
MOVES = 0.5  # standard deviations by which an explanation moves a density of which it says something


@dataclass(frozen=True)
class HeldOut:
    """Errors of the groups that were held out, in percent.

    Parameters
    ----------
    groups : test and mode.
    before, after : of the declared model and of the explanation.
    noise : what the measurement and the mesh leave uncertain.
    what : one line for the report.
    """

    groups: tuple[Group, ...]
    before: tuple[float, ...]
    after: tuple[float, ...]
    noise: tuple[float, ...]
    what: str = "each mode predicted from fits that did not see it (three folds)"

    @property
    def informative(self) -> int:
        """Number of groups that the declared model misses by more than their noise explains."""
        return sum(b > ERRORS * n for b, n in zip(self.before, self.noise, strict=True))

    @property
    def before_rms(self) -> float:
        return _rms(self.before)

    @property
    def after_rms(self) -> float:
        return _rms(self.after)

    @property
    def falls(self) -> bool:
        """Whether the error falls by enough, and by more than chance."""
        if not self.groups or self.after_rms > (1 - LEAST_FALL) * self.before_rms:
            return False
        # logarithms: one large error is not all that counts; nothing is smaller than its noise
        ratio = [
            np.log(max(b, n) / max(a, n)) for b, a, n in zip(self.before, self.after, self.noise, strict=True)
        ]
        spread = float(np.std(ratio, ddof=1)) / np.sqrt(len(ratio)) if len(ratio) > 1 else np.inf
        return float(np.mean(ratio)) > ERRORS * spread or self._by_chi2

    @property
    def _by_chi2(self) -> bool:
        """The fall of the squared errors in units of noise, against its own standard error."""
        b, a, n = (np.array(v) for v in (self.before, self.after, self.noise))
        fall = float(np.sum((b / n) ** 2 - (a / n) ** 2))
        return fall > ERRORS * float(np.sqrt(2 * len(b) + 4 * np.sum((a / n) ** 2))) and fall > 0

    @property
    def worsens(self) -> bool:
        """Whether a test's error grows beyond its noise."""
        for test in {g[0] for g in self.groups}:
            own = [i for i, g in enumerate(self.groups) if g[0] == test]
            b, a, n = (_rms([v[i] for i in own]) for v in (self.before, self.after, self.noise))
            if a > WORSE * max(b, n):
                return True
        return False


def held_out(base: Refit, explanation: Explanation) -> HeldOut:
    """Hold out every third mode in turn; where modes do not tell, the densities that an explanation moves.

    A density is what no recording saw: that the recordings alone ask for a plausible one is a test of its own.
    """
    groups = [g for g in _groups(base, explanation) if g != WEIGHED]
    found = _predicted(base, explanation, [frozenset(groups[k::FOLDS]) for k in range(FOLDS)])
    if not found.falls and not found.worsens and _moves_densities(base, explanation):
        weighed = _predicted(base, explanation, [frozenset([WEIGHED])])
        if weighed.falls:
            return replace(weighed, what="densities of the regions predicted from the recordings alone")
    return found


def _predicted(base: Refit, explanation: Explanation, folds: Sequence[frozenset[Group]]) -> HeldOut:
    groups = {g for fold in folds for g in fold}
    rows: dict[Group, tuple[float, float, float]] = {}
    for fold in folds:
        if not fold or (len(fold) == len(groups) and fold != {WEIGHED}):
            continue
        errors = [_errors(r, fold) for r in (base, explanation.refit)]
        for group in fold:
            if all(group in e for e in errors):
                rows[group] = (errors[0][group][0], errors[1][group][0], errors[0][group][1])
    used = sorted(rows, key=str)
    return HeldOut(
        tuple(used),
        tuple(rows[g][0] for g in used),
        tuple(rows[g][1] for g in used),
        tuple(rows[g][2] for g in used),
    )


def _groups(base: Refit, explanation: Explanation) -> list[Group]:
    """Modes that both have a partner for, tests mixed."""
    both = [
        {f.group for f in r.hypothesis.features(r.z) if f.kind in WEIGHT and not f.lost}
        for r in (base, explanation.refit)
    ]
    return sorted(both[0] & both[1], key=str)


def _moves_densities(base: Refit, explanation: Explanation) -> bool:
    """Whether an explanation says something of densities."""
    old, new = (
        [f for f in r.hypothesis.features(r.z) if f.kind == "density"] for r in (base, explanation.refit)
    )
    return any(abs(a.measured - b.measured) > MOVES * a.sd for a, b in zip(old, new, strict=True))


def groups_of(base: Refit) -> list[Group]:
    """Modes that have a partner, tests mixed; densities left out."""
    features = base.hypothesis.features(base.z)
    return sorted({f.group for f in features if f.kind in WEIGHT and not f.lost} - {WEIGHED}, key=str)


def _errors(full: Refit, fold: frozenset[Group]) -> dict[Group, tuple[float, float]]:
    """Errors of a fold in percent, and their noise, after a fit without it."""
    hypothesis: AnyHypothesis = replace(full.hypothesis, left_out=fold)
    try:
        trained = refit_held(hypothesis, full.z)
    except StatorhomError:
        return {}
    return left_out_errors(trained.hypothesis, trained.z)


def left_out_errors(hypothesis: AnyHypothesis, z: np.ndarray) -> dict[Group, tuple[float, float]]:
    """Errors of what a hypothesis leaves out in percent, and their noise."""
    found: dict[Group, list[Feature]] = {}
    for feature in hypothesis.features(z, left_out=True):
        if feature.kind in WEIGHT and not feature.lost and feature.sd < 0.5 * _scale(feature):
            found.setdefault(feature.group, []).append(feature)
    return {group: (_error(features), _noise(features)) for group, features in found.items()}


def refit_held(hypothesis: _H, z: np.ndarray) -> Refit[_H]:
    """Fit with the pairing as it is."""
    return refit(hypothesis, z, rounds=1)


def _error(features: Sequence[Feature]) -> float:
    return 100 * float(
        np.sqrt(sum((WEIGHT[f.kind] * (f.measured - f.predicted) / _scale(f)) ** 2 for f in features))
    )


def _noise(features: Sequence[Feature]) -> float:
    return 100 * float(np.sqrt(sum((WEIGHT[f.kind] * f.sd / _scale(f)) ** 2 for f in features)))


def _scale(feature: Feature) -> float:
    """What an error of 1 is: all features are relative but densities."""
    return feature.predicted if feature.kind == "density" else 1.0


def _rms(values: Sequence[float]) -> float:
    return float(np.sqrt(np.mean(np.square(values)))) if len(values) else 0.0
