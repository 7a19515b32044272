"""Explanations of the misfit: the best candidates of every effect refitted, with their evidence."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Generic

import numpy as np
from scipy.special import logsumexp
from scipy.stats import chi2
from typing_extensions import TypeVar

from statorhom.diagnose.any_hypothesis import AnyHypothesis
from statorhom.diagnose.mislabelled import worth_trying
from statorhom.diagnose.refit import H, Refit, refit
from statorhom.diagnose.scan import Scan, Signature
from statorhom.errors import StatorhomError
from statorhom.physics.candidate import Candidate

_H = TypeVar("_H", bound=AnyHypothesis)

COARSE = 0.03
STARTS = 2  # of one candidate
WORTH = 2.0  # gain of the scan below which an effect is not refitted
MOST = 12  # candidates that are refitted
RELABELLED = 4
ADEQUATE = 0.01  # chance of a misfit above which nothing is left to explain
ROWS = 8  # of which one may be grossly wrong
DRAWS = 4000
POOR = 3.0  # squared residual per feature above which another valley is looked for


@dataclass(frozen=True, eq=False)
class Explanation(Generic[H]):
    """One or more effects at their optimum.

    Parameters
    ----------
    candidates : the effects.
    refit : of all constants.
    log_evidence : with the prior over the effects' candidates.
    """

    candidates: tuple[Candidate, ...]
    refit: Refit[H]
    log_evidence: float

    @property
    def effects(self) -> tuple[str, ...]:
        """Names."""
        return tuple(c.effect for c in self.candidates)

    @property
    def adequacy(self) -> float:
        """Chance of a misfit at least as large, if the explanation is right.

        What is known of the constants counts like a measurement; how large an effect usually is does not: for that
        there are physical limits.
        """
        return float(chi2.sf(self._misfit, max(len(self._residuals[0]), 1)))

    @property
    def adequacy_but_one(self) -> float:
        """The same without the worst row, against the chance of such a rest: one gross error is no missing physics."""
        rows, worst = len(self._residuals[0]), float(np.max(self._residuals[0] ** 2, initial=0.0))
        if rows < ROWS:
            return self.adequacy
        draws = np.random.default_rng(0).chisquare(1.0, (DRAWS, rows))
        rest = draws.sum(axis=1) - draws.max(axis=1)
        return float(np.mean(rest >= self._misfit - worst))

    @property
    def _misfit(self) -> float:
        r = self.refit
        effect = slice(r.hypothesis.constants, None)
        unusual = float(np.sum(r.hypothesis.prior_weights[effect] * r.z[effect] ** 2))
        return r.objective - r.hypothesis.missed - unusual - float(np.sum(self._residuals[1] ** 2))

    @cached_property
    def _residuals(self) -> tuple[np.ndarray, np.ndarray]:
        """Those that count, and those of loss factors and shapes: many and uncertain, they would hide a frequency."""
        found = self.refit.hypothesis.features(self.refit.z)
        lossy = np.array([f.kind in ("loss", "shape") for f in found], dtype=bool)
        residuals = np.array([f.residual for f in found])
        return residuals[~lossy], residuals[lossy]


def nothing(base: Refit) -> Explanation:
    """The declared model."""
    return Explanation((), base, base.log_evidence)


def single_effects(
    base: Refit, found: Scan, discrete: Sequence[Candidate], counts: dict[str, int]
) -> list[Explanation]:
    """Refits of the most promising candidates of every effect, the best of each effect first in its list.

    Parameters
    ----------
    base : the declared model's optimum.
    found : the scan.
    discrete : candidates without parameters.
    counts : effect → number of its candidates, over which its prior is spread.
    """
    explanations: list[Explanation] = []
    for signature in found.worth_refitting(MOST, WORTH, nothing(base).adequacy < ADEQUATE):
        if signature.gain < WORTH and _solved(explanations):
            continue  # it promises nothing, and nothing is left to explain
        best = _best_refit(base, _starts_of(found, signature), _solved(explanations))
        if best is not None:
            explanations.append(explained(best, counts))
    for candidate in worth_trying(base, discrete)[:RELABELLED]:
        best = _best_refit(base, [(candidate, np.empty(0))], _solved(explanations))
        if best is not None:
            explanations.append(explained(best, counts))
    return sorted(explanations, key=lambda e: -e.log_evidence)


def _solved(explanations: Sequence[Explanation]) -> bool:
    """Whether one of them leaves nothing to explain: others then need not be sought in every valley."""
    return any(e.adequacy > ADEQUATE for e in explanations)


def with_second(first: Explanation, others: Sequence[Signature], counts: dict[str, int]) -> list[Explanation]:
    """The first explanation and one more effect."""
    found = []
    for signature in others:
        start = np.r_[first.refit.z, signature.start]
        hypothesis = blank(first.refit.hypothesis, (*first.candidates, signature.candidate))
        best = refitted(hypothesis, start)
        if best is not None:
            found.append(explained(best, counts))
    return sorted(found, key=lambda e: -e.log_evidence)


def explained(best: Refit, counts: dict[str, int]) -> Explanation:
    """A refit with the prior over the effects' candidates."""
    candidates = best.hypothesis.candidates
    prior = -sum(float(np.log(max(1, counts.get(c.effect, 1)))) for c in candidates)
    return Explanation(candidates, best, best.log_evidence + prior)


def _starts_of(found: Scan, signature: Signature) -> list[tuple[Candidate, np.ndarray]]:
    """The best starts of a candidate that are not neighbours, and those of its other magnitudes."""
    own = [s for s in found.signatures if s.candidate.label == signature.candidate.label]
    chosen: list[Signature] = []
    for one in own:
        if all(abs(float(one.change @ other.change)) < 0.9 for other in chosen):
            chosen.append(one)
    return [(s.candidate, s.start) for s in chosen[:STARTS]]


def _best_refit(base: Refit, places: Sequence[tuple[Candidate, np.ndarray]], solved: bool) -> Refit | None:
    found: list[Refit] = []
    for candidate, start in places:
        z = np.r_[base.z, start]
        hypothesis = blank(base.hypothesis, (candidate,))
        best = refitted(hypothesis, z)
        if not solved and (best is None or best.misfit > POOR * len(best.jacobian)):
            # a wide valley first: partners may change on the way
            rough = refitted(replace(hypothesis, discrepancy=COARSE), z)
            sharp = None if rough is None else refitted(hypothesis, rough.z)
            best = min((r for r in (best, sharp) if r), key=lambda r: r.objective, default=None)
        if best is not None:
            found.append(best)
    return min(found, key=lambda r: r.objective, default=None)


def blank(hypothesis: _H, candidates: tuple[Candidate, ...]) -> _H:
    """The same with other effects, and modes to be paired anew."""
    return replace(hypothesis, candidates=candidates, held=None, missed=0.0)


def refitted(hypothesis: _H, z: np.ndarray) -> Refit[_H] | None:
    """The nearest optimum; None where no stator has the constants of the start."""
    try:
        return refit(hypothesis, z)
    except (StatorhomError, KeyError):
        return None


def effect_evidence(explanations: Sequence[Explanation]) -> dict[tuple[str, ...], float]:
    """ln Z of every combination of effects, its candidates summed."""
    found: dict[tuple[str, ...], list[float]] = {}
    for e in explanations:
        found.setdefault(e.effects, []).append(e.log_evidence)
    return {effects: float(logsumexp(values)) for effects, values in found.items()}
