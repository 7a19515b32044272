"""The rules by which an effect is named (physics.md §8)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from statorhom.diagnose.evidence.held_out import HeldOut
from statorhom.diagnose.fits.explanations import ADEQUATE, Explanation

Verdict = Literal["none", "named", "ambiguous", "unknown"]
MAX_T_P = 0.01
OVER_NOTHING, OVER_OTHERS = 5.0, 3.0  # of log evidence
# The same where the declared model misses nothing by more than chance, or where too few modes show the effect for
# held-out ones to confirm it: as much and ln of the number of effects, any of which may have found something in the
# noise. Of rivals and of something in no library few modes tell it apart by more, too.
OVER_ADEQUATE, FAR_OVER_OTHERS = 8.0, 5.0
# The same where held-out modes do not confirm it at all; what is so far ahead is beyond doubt.
FAR_OVER_NOTHING = 20.0
# What is asked over something in no library: so much per share that is left of the error in unseen modes, and less by
# this power of e with the chance of what is left of the rows. What looks like the truth leaves more of either: of 30
# and 36 explanations of development tables, right and false, logistic regressions gave powers of lead, share and chance
# of 0.9, -0.4 and 7.9, and of 1.0, -1.6 and 4.6. Standard deviations hold all that mesh, scatter and foot may do, so
# that right ones leave less than these say. Of the share no more counts than `MOST_LEFT`: errors that hardly fall
# contradict elsewhere.
PER_SHARE, BY_CHANCE = 4500.0, 8.5
MOST_LEFT = 0.5
NEAR_RIVAL = 10.0  # of log evidence: up to which a rival and the best are compared in models of their own
AS_IT_SHOULD = 0.1  # chance of a misfit from which on there is nothing to explain
STABLE = 0.8
FEW = 4  # modes that show an effect, below which held-out modes cannot decide
NEAR_BOUND = 0.02  # of a parameter's range, in its own scale


@dataclass(frozen=True)
class Evidence:
    """What the rules look at.

    Parameters
    ----------
    p_value : of the scan's maximum.
    unpaired : whether the declared model lacks many modes that were measured: what has no partner, no scan sees.
    over_nothing, over_others : log evidence of the best explanation over "nothing" and over the next one.
    over_discrepancy : and over modes that are off by chance (`statorhom.diagnose.evidence.free_discrepancy`).
    held_out : errors on modes that were not seen; None where there were too few.
    adequacy : posterior-predictive p of the best explanation, one gross error aside.
    chance_of_rows : of what it leaves of the rows alone (`Explanation.chance_of_rows`).
    nothing_adequacy, nothing_but_one : and of the declared model, with every row and without the worst.
    within : whether all magnitudes lie inside their physical ranges, off the bounds and off what would be absence.
    stability : share of resamplings with the same winner.
    confirmed : of two effects, whether held-out modes confirm the second one beside the first alone.
    """

    p_value: float
    unpaired: bool
    over_nothing: float
    over_others: float
    over_discrepancy: float
    held_out: HeldOut | None
    adequacy: float
    chance_of_rows: float
    nothing_adequacy: float
    nothing_but_one: float
    within: bool
    stability: float
    confirmed: bool = True

    @property
    def by_chance(self) -> bool:
        """Rule 1: what the declared model misses may be chance."""
        return is_chance(self.p_value, self.unpaired)

    @property
    def detected(self) -> bool:
        """Rule 1, and the first part of rule 2: something is missing."""
        return not self.by_chance and self.over_nothing > self.least_over_nothing

    @property
    def least_over_nothing(self) -> float:
        """Log evidence that is asked for."""
        return least_over_nothing(self.nothing_adequacy)

    @property
    def predicts(self) -> bool:
        """Rule 3."""
        unseen = self.held_out
        return unseen is not None and unseen.falls and not unseen.worsens and not unseen.of_lines

    @property
    def evident(self) -> bool:
        """Whether the evidence alone names it, where the few modes that show it are predicted better than before.

        Lines beside their mates confirm that something parts them, and say little of which of two rivals does: that the
        evidence does.
        """
        unseen = self.held_out
        if unseen is None:
            return False
        if unseen.of_lines:
            return self.over_others > OVER_OTHERS and unseen.falls and not unseen.worsens
        if self.over_others <= FAR_OVER_OTHERS:
            return False
        if unseen.improves:
            return self.over_nothing > OVER_ADEQUATE and self.over_discrepancy > FAR_OVER_OTHERS
        return self.beyond_doubt

    @property
    def beyond_doubt(self) -> bool:
        """Whether unseen modes need not confirm it: they are few and contradict nothing, and all else is far behind.

        What constants can make up for of a wrong length they make up for in unseen modes too. Effects of no library may
        be as strong, so that something in none has to be as far behind as nothing.
        """
        unseen = self.held_out
        if unseen is None or not too_few(unseen) or unseen.contradicts:
            return False
        return min(self.over_nothing, self.over_discrepancy) > FAR_OVER_NOTHING

    @property
    def sound(self) -> bool:
        """Rule 4."""
        return self.adequacy > ADEQUATE and self.within

    @property
    def in_library(self) -> bool:
        """Last part of rule 2: something that is in no library would not do as well.

        It is a candidate like every other. What leaves more than right explanations leave, of the modes that were seen
        and of those that were not, has to be far ahead of it: lumps in several places look like one, and a mass on a
        spring like a rigid one, but not quite.
        """
        return self.over_discrepancy > self.least_over_discrepancy

    @property
    def least_over_discrepancy(self) -> float:
        """Log evidence that is asked for: the more, the more is left of what was seen and of what was not."""
        left = MOST_LEFT if self.held_out is None else min(self.held_out.share_left, MOST_LEFT)
        asked = PER_SHARE * left * np.exp(-BY_CHANCE * self.chance_of_rows)
        return float(np.clip(asked, OVER_OTHERS, FAR_OVER_NOTHING))

    @property
    def undecided(self) -> bool:
        """Whether rule 3 has too few modes that show anything: they cannot contradict, nor can they confirm."""
        few = self.held_out is None or too_few(self.held_out)
        return few and bool(np.isfinite(self.over_others))


def least_over_nothing(adequacy: float) -> float:
    """Log evidence over "nothing" that is asked of a name; `adequacy` is the declared model's."""
    return OVER_ADEQUATE if adequacy > AS_IT_SHOULD else OVER_NOTHING


def too_few(unseen: HeldOut) -> bool:
    """Whether too few modes show what is missing for held-out ones to confirm or to contradict it.

    A mode's line fits with its mate by whatever parts them: it is no mode of its own.
    """
    return (unseen.informative < FEW or unseen.of_lines) and not unseen.worsens


def is_chance(p_value: float, unpaired: bool) -> bool:
    """Whether a misfit may be chance; many modes without a partner are none."""
    return p_value >= MAX_T_P and not unpaired


def decide(evidence: Evidence) -> Verdict:
    """The verdict; several effects are named as alternatives only where there are several."""
    if not evidence.detected:
        # one gross row that no effect explains is a slip of whoever measured, or of the extraction
        enough = max(evidence.nothing_adequacy, evidence.nothing_but_one) > ADEQUATE
        return "none" if enough or evidence.by_chance else "unknown"
    if not evidence.sound or not (evidence.predicts or evidence.evident or evidence.undecided):
        return "unknown" if evidence.nothing_adequacy <= ADEQUATE else "none"
    if not (evidence.predicts or evidence.evident) or not evidence.confirmed:
        return "ambiguous"
    # resamplings are lost to rivals alone, so that an unstable winner has some
    if evidence.over_others <= OVER_OTHERS or evidence.stability < STABLE:
        return "ambiguous"
    return "named" if evidence.in_library else "unknown"


def within_bounds(explanation: Explanation) -> bool:
    """Whether no magnitude lies on a bound of its physical range, nor within the tolerance of what it corrects."""
    values = explanation.refit.hypothesis.effect_values(explanation.refit.z)
    for candidate, found in zip(explanation.candidates, values, strict=True):
        for p in candidate.magnitudes:
            if p.absent is not None and abs(found[p.name] - p.absent) < p.negligible:
                return False
            low, value, high = (
                (np.log(v) if p.scale == "log" else v) for v in (p.lower, found[p.name], p.upper)
            )
            if not low + NEAR_BOUND * (high - low) < value < high - NEAR_BOUND * (high - low):
                return False
    return True


def others(best: Explanation, explanations: Sequence[Explanation]) -> list[Explanation]:
    """The best explanation of every other combination of effects."""
    found: dict[tuple[str, ...], Explanation] = {}
    for e in explanations:
        if set(e.effects) != set(best.effects) and not set(best.effects) < set(e.effects):
            found.setdefault(tuple(sorted(e.effects)), e)
    return sorted(found.values(), key=lambda e: -e.log_evidence)
