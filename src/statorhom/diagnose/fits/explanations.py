"""Explanations of the misfit: effects at their optimum, with their evidence."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cache, cached_property
from typing import Generic

import numpy as np
from scipy.special import logsumexp
from scipy.stats import chi2
from typing_extensions import TypeVar

from statorhom.diagnose.fits.any_hypothesis import AnyHypothesis
from statorhom.diagnose.fits.refit import H, Refit, refit
from statorhom.diagnose.measured.feature import Feature
from statorhom.errors import StatorhomError
from statorhom.model.convergence import ModeKey
from statorhom.physics.candidate import Candidate

_H = TypeVar("_H", bound=AnyHypothesis)

COARSE = 0.03  # discrepancy with which wide valleys are found
NARROWING = (0.01, 0.003)
ADEQUATE = 0.01  # chance of a misfit above which nothing is left to explain
UNUSUAL = 0.2  # chance of a misfit up to which better explanations are sought than what was found
WELL = 0.1  # and above which no deeper valley is sought
UNCERTAIN = ("loss", "shape")  # kinds of features: many and uncertain, they would hide a frequency
ROWS = 8  # of which one may be grossly wrong
DRAWS = 4000
PAIR_GAIN = 5.0  # log evidence that a second effect must add


@dataclass(frozen=True, eq=False)
class Explanation(Generic[H]):
    """One or more effects at their optimum.

    Parameters
    ----------
    candidates : the effects.
    refit : of all constants.
    log_evidence : with the prior over the effects' candidates.
    compared : refit by which it is compared with others, where that is another one.
    settled : whether it stands in a model of its own, and in the deepest valley that was found there.
    """

    candidates: tuple[Candidate, ...]
    refit: Refit[H]
    log_evidence: float
    compared: Refit[H] | None = None
    settled: bool = False

    @property
    def effects(self) -> tuple[str, ...]:
        """Names."""
        return tuple(c.effect for c in self.candidates)

    @property
    def is_pair(self) -> bool:
        """Whether it takes more than one effect."""
        return len(self.candidates) > 1

    @property
    def label(self) -> str:
        """Of its candidates."""
        return " + ".join(c.label for c in self.candidates)

    def at(self, other: Refit[H]) -> Explanation[H]:
        """The same at another optimum."""
        gained = other.log_evidence - self.refit.log_evidence
        return replace(self, refit=other, log_evidence=self.log_evidence + gained)

    @property
    def set_aside(self) -> frozenset[tuple[str, ModeKey | None]]:
        """Groups of features that no explanation explains: they tell nothing of which one is right."""
        return frozenset() if self.compared is None else self.compared.hypothesis.left_out

    @property
    def adequacy(self) -> float:
        """Chance of a misfit at least as large, if the explanation is right.

        What is known of the constants counts like a measurement; how large an effect usually is does not: for that
        there are physical limits.
        """
        return float(chi2.sf(self._misfit, max(len(self._residuals[0]), 1)))

    @property
    def adequacy_but_one(self) -> float:
        """The same without the worst row, against the chance of such a rest: one gross error is no missing physics.

        An impossible density is no row of a table that somebody has mistyped.
        """
        rows, worst = len(self._residuals[0]), float(np.max(self._of_modes**2, initial=0.0))
        if rows < ROWS:
            return self.adequacy
        return float(np.mean(_rests(rows) >= self._misfit - worst))

    @property
    def adequacy_of_all(self) -> float:
        """The same with losses and shapes too, and with what is unusual by the priors of the effects."""
        return float(chi2.sf(self.refit.objective, max(len(self.refit.jacobian), 1)))

    @property
    def chance_of_rows(self) -> float:
        """Chance that a right explanation leaves as much of the rows, however unusual its constants are.

        If data and constants are what they are said to be, a refit leaves normal deviates of the rows, of covariance
        I - J (JᵀJ + W)⁻¹ Jᵀ, W the prior's precision. Their sum of squares is about a multiple of χ² (Satterthwaite
        (1946), Biometrics Bulletin 2, 110). What is unusual of constants is so beside every explanation. That was
        looked at in tables alone: by recordings right explanations are adequate to 0.95 and more, and that counts.
        """
        certain = np.array([f.kind not in UNCERTAIN for f in self._features], dtype=bool)
        if not certain.any():
            return 1.0
        left = self.refit.left_of_noise[np.ix_(certain, certain)]
        mean, square = float(np.trace(left)), float(np.sum(left**2))
        chance = float(chi2.sf(np.sum(self._residuals[0] ** 2) * mean / square, mean**2 / square))
        return max(chance, self.adequacy_but_one) if was_recorded(self.refit) else chance

    @property
    def _misfit(self) -> float:
        r = self.refit
        effect = slice(r.hypothesis.constants, None)
        unusual = float(np.sum(r.hypothesis.prior_weights[effect] * r.z[effect] ** 2))
        return r.objective - r.hypothesis.charge(r.z) - unusual - float(np.sum(self._residuals[1] ** 2))

    @property
    def _of_modes(self) -> np.ndarray:
        """Residuals that count, without those of densities."""
        found = self._features
        return np.array([f.residual for f in found if f.kind not in (*UNCERTAIN, "density")])

    @cached_property
    def _features(self) -> Sequence[Feature]:
        return self.refit.hypothesis.features(self.refit.z)

    @cached_property
    def _residuals(self) -> tuple[np.ndarray, np.ndarray]:
        """Those that count, and those of uncertain kinds."""
        found = self._features
        lossy = np.array([f.kind in UNCERTAIN for f in found], dtype=bool)
        residuals = np.array([f.residual for f in found])
        return residuals[~lossy], residuals[lossy]


def was_recorded(r: Refit[AnyHypothesis]) -> bool:
    """Whether any test was recorded: then angles and leans are told."""
    return any(test.recorded for step in r.hypothesis.study.stages for test in step.tests)


@cache
def _rests(rows: int) -> np.ndarray:
    """Draws (`DRAWS`,) of a sum of squares of noise without its largest one."""
    draws = np.random.default_rng(0).chisquare(1.0, (DRAWS, rows))
    return np.asarray(draws.sum(axis=1) - draws.max(axis=1))


def nothing(base: Refit) -> Explanation:
    """The declared model."""
    return Explanation((), base, base.log_evidence)


def explained(best: Refit, counts: dict[str, int]) -> Explanation:
    """A refit with the prior over the effects' candidates; two of one on both sides have to gain what a second has to.

    To the frequencies of a symmetric body one lump and two halves of it on both sides look almost the same.
    """
    candidates = best.hypothesis.candidates
    prior = -sum(float(np.log(max(1, counts.get(c.effect, 1)))) for c in candidates)
    prior -= PAIR_GAIN * sum(c.both_sides for c in candidates)
    return Explanation(candidates, best, best.log_evidence + prior)


def blank(hypothesis: _H, candidates: tuple[Candidate, ...]) -> _H:
    """The same with other effects, and modes to be paired anew."""
    return hypothesis.of_others(candidates)


def refitted(hypothesis: _H, z: np.ndarray, worth: float = np.inf) -> Refit[_H] | None:
    """The nearest optimum; None where no body has the constants of the start.

    Parameters
    ----------
    hypothesis, z : what, and from where.
    worth : objective from which on a result matters to nobody (`statorhom.diagnose.fits.refit.refit`).
    """
    try:
        return refit(hypothesis, z, worth=worth)
    except (StatorhomError, KeyError):
        return None


def widened(hypothesis: _H, z: np.ndarray) -> Refit[_H] | None:
    """The optimum in wide valleys, seen by frequencies alone; without what is dear, which matters little there."""
    return refitted(replace(hypothesis, held=None, discrepancy=COARSE, trained=False), z)


def through_wide_valleys(hypothesis: _H, z: np.ndarray, rough: Refit[_H] | None = None) -> Refit[_H] | None:
    """The optimum next to that in wide valleys, which may be known: partners may change on the way.

    Valleys narrow by degrees: from a wide one straight into the narrowest, a side valley is the nearest.
    """
    found = rough or widened(hypothesis, z)
    return None if found is None else refitted(replace(hypothesis, held=None), narrowed(found).z)


def in_valleys(hypothesis: _H, z: np.ndarray, discrepancy: float) -> Refit[_H] | None:
    """The optimum next to a point in valleys of some width."""
    return refitted(replace(hypothesis, held=None, discrepancy=discrepancy), z)


def narrowed(rough: Refit[_H], steps: Sequence[float] = NARROWING) -> Refit[_H]:
    """An optimum in wide valleys, followed as far as it can be without their narrowest part."""
    for discrepancy in steps:
        rough = in_valleys(rough.hypothesis, rough.z, discrepancy) or rough
    return rough


def best_narrowed(hypothesis: _H, wide: Sequence[Refit[_H]]) -> Refit[_H] | None:
    """The best of what optima in wide valleys lead to."""
    refits = [refitted(hypothesis, narrowed(rough).z) for rough in wide]
    return min((r for r in refits if r is not None), key=lambda r: r.objective, default=None)


def by_degrees(hypothesis: _H, z: np.ndarray) -> Refit[_H] | None:
    """The optimum next to a point of another model, through valleys that narrow by degrees."""
    wide = in_valleys(hypothesis, z, NARROWING[0])
    return None if wide is None else refitted(replace(hypothesis, held=None), narrowed(wide, NARROWING[1:]).z)


def best_of_each(found: Sequence[Explanation]) -> dict[str, Explanation]:
    """The best explanation by every candidate, the best first."""
    best: dict[str, Explanation] = {}
    for e in sorted(found, key=lambda e: -e.log_evidence):
        best.setdefault(e.label, e)
    return best


def effect_evidence(explanations: Sequence[Explanation]) -> dict[tuple[str, ...], float]:
    """ln Z of every combination of effects, its candidates summed."""
    found: dict[tuple[str, ...], list[float]] = {}
    for e in explanations:
        found.setdefault(e.effects, []).append(e.log_evidence)
    return {effects: float(logsumexp(values)) for effects, values in found.items()}


def effects_over(none: Explanation, best: Explanation, found: Sequence[Explanation]) -> float:
    """Log evidence of an explanation's effects over the declared model, all candidates of them together."""
    return effect_evidence(found).get(best.effects, best.log_evidence) - none.log_evidence
