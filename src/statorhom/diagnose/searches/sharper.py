"""Explanations in models of their own: basis and mesh factors at their own materials, and in the deepest valley.

The scan and the first refits stand in the declared model's basis, whose materials may be far from an explanation's: the
difference looks like more physics left out. Constants of a winding that were found under a wrong belief may lie in a
valley that the right belief does not have.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from statorhom.diagnose.evidence.decision import NEAR_RIVAL
from statorhom.diagnose.fits.explanations import (
    ADEQUATE,
    WELL,
    Explanation,
    explained,
    refitted,
    through_wide_valleys,
    widened,
)
from statorhom.diagnose.fits.own_model import AROUND, ITSELF, in_its_own_model
from statorhom.diagnose.fits.refit import Refit, refit, refit_objective
from statorhom.diagnose.fits.valleys import APART, FAR_BEHIND, SETTLED, Reached, best_of_sides, is_apart
from statorhom.diagnose.located.mirrored import at_fitting_height
from statorhom.diagnose.searches.best_refit import is_a_field
from statorhom.errors import StatorhomError

MOST = 3  # explanations that get models of their own before a second effect is sought
ROUNDS = 3  # models of one explanation
CERTAIN = 0.9  # chance of the way in which modes are called, from which on there is no other to speak of
MOVED = (
    0.2  # of the logarithm of a stiffness: from its reference, at which what breaks the symmetry is solved
)
WORSE = 10.0  # of the cost, by which a model of its own is worse than the common one
AWAY = 2.0  # of the objective, by which an optimum is none in its own model
HOPELESS = 50.0  # of the objective: what promises no better from other constants does not get there
BEHIND = 150.0  # log evidence by which others are too far behind for that


def sharpened(explanation: Explanation, *, leads: bool = True) -> Explanation:
    """The same with basis and mesh factors of its own materials, anew while that explains more.

    What breaks the symmetry is solved at the reference: where that was far off, the constants move with it.

    Parameters
    ----------
    explanation : a refit.
    leads : whether constants are tried on their other sides too where that is dear.
    """
    around = AROUND if leads else ITSELF
    found = _sharpened(explanation, around)
    for _ in range(ROUNDS - 1):
        gained = explanation.refit.objective - found.refit.objective
        if found.adequacy_but_one > ADEQUATE or gained < SETTLED:
            break
        explanation, found = found, _sharpened(found, around)
    found = replace(found, settled=True)
    cheap = keeps_symmetry(found.refit)
    # where every start needs a model of its own, what is good enough for a name is good enough, but where modes mix:
    # with every other way of calling them there may be another valley
    enough = found.adequacy_but_one > (WELL if cheap else ADEQUATE) and not _mixes(found.refit)
    if enough or not (leads or cheap):
        return found
    deeper = at_fitting_height(_on_other_sides(found.refit))
    if deeper is found.refit:
        return found
    return min(found, _sharpened(replace(found, refit=deeper), around), key=lambda e: e.refit.cost)


def at_its_own_materials(explanation: Explanation) -> Explanation:
    """What is reported: where constants have left the materials at which the broken symmetry is solved, solved anew.

    An explanation that leaves no more than noise may still be on its way: what is unequal along the axis and how stiff
    it is in the mean make up for each other, and both follow the reference.
    """
    return _anew(
        explanation, lambda r: not keeps_symmetry(r) and (_has_moved(r) or is_a_field(r.hypothesis, r.z))
    )


def in_its_own_models(explanation: Explanation) -> Explanation:
    """The same in models at its own materials, anew as long as that explains more."""
    return replace(_anew(explanation, lambda _: True), settled=True)


def _anew(explanation: Explanation, is_worth_it: Callable[[Refit], bool]) -> Explanation:
    """Models of its own, one after the other, while they are worth it and gain anything."""
    for _ in range(ROUNDS):
        if not is_worth_it(explanation.refit):
            break
        again = _sharpened(explanation)
        gained = explanation.refit.objective - again.refit.objective
        if gained > 0 or refines(again.refit, explanation.refit):
            explanation = again
        if gained < SETTLED:
            break
    return explanation


def refines(now: Refit, before: Refit) -> bool:
    """Whether a finer mesh has told the one optimum and not the other, and leaves hardly more.

    What a coarse mesh has too little room for, constants and sizes may make up for: that it leaves less is no merit.
    """
    of_now, of_before = (_is_refined(r) for r in (now, before))
    return of_now and not of_before and now.cost < before.cost + WORSE


def _is_refined(r: Refit) -> bool:
    return any(stage.refinement is not None for stage in r.hypothesis.study.stages)


def _mixes(r: Refit) -> bool:
    """Whether some mode's lines may be called otherwise."""
    return any(feature.chance < CERTAIN for feature in r.hypothesis.features(r.z))


def _has_moved(r: Refit) -> bool:
    """Whether any region's stiffness has left that of its stage's reference."""
    for stage in r.hypothesis.study.stages:
        materials = r.hypothesis.materials(stage, r.z)
        for region, reference in stage.reference.items():
            now, then = (np.diag(m.hooke.matrix) for m in (materials[region], reference))
            if np.abs(np.log(now / then)).max() > MOVED:
                return True
    return False


def _sharpened(explanation: Explanation, around: tuple[float, ...] = AROUND) -> Explanation:
    r = explanation.refit
    moved = in_its_own_model(r.hypothesis, r.z, around=around)
    again = refitted(moved, r.z)
    if again is not None and _leads_past(r, again):
        middle = _half_way(r, again, around)
        again = min((x for x in (again, middle) if x is not None), key=lambda x: x.objective)
    if again is None or again.cost > r.cost + WORSE:
        # other mesh factors may have put the constants onto a slope of another valley
        wide = through_wide_valleys(moved, r.z)
        # and where two modes come near each other, a mesh factor may be that of the other one
        again = min((x for x in (again, wide, r) if x is not None), key=lambda x: x.cost)
    return replace(explanation, refit=again)


def _leads_past(r: Refit, again: Refit) -> bool:
    """Whether an optimum's own model leads away from it without a gain.

    What breaks the symmetry strongly is off by more the further it is from where it was solved: then either optimum
    stands where the other one's model is wrong.
    """
    if keeps_symmetry(r) or again.objective < r.objective - SETTLED:
        return False
    return refit_objective(again.hypothesis, r.z) > again.objective + AWAY


def _half_way(r: Refit, again: Refit, around: tuple[float, ...]) -> Refit | None:
    """The optimum in the model of what lies between the two; None where no stator has that."""
    middle = 0.5 * (r.z + again.z)
    try:
        return refitted(in_its_own_model(r.hypothesis, middle, around=around), middle)
    except (StatorhomError, KeyError):
        return None


def refined(
    explanations: Sequence[Explanation], valleys: Sequence[np.ndarray], counts: dict[str, int]
) -> list[Explanation]:
    """The leading explanations in models of their own and from the constants of other valleys; the best first.

    Parameters
    ----------
    explanations : the best first.
    valleys : constants at other optima of the declared model.
    counts : effect → number of its candidates.
    """
    if not explanations:
        return []
    adequate = explanations[0].adequacy_but_one > ADEQUATE
    least = explanations[0].log_evidence - (NEAR_RIVAL if adequate else BEHIND)

    def better(e: Explanation) -> Explanation:
        leads = e is explanations[0]
        own = sharpened(e, leads=leads)
        # what leads is good enough where it explains all; a rival so near has to be seen at its best
        return _settled((own if adequate and leads else _deepest(own, valleys, counts)).refit, counts)

    found = [better(e) if i < MOST and e.log_evidence > least else e for i, e in enumerate(explanations)]
    return sorted(found, key=lambda e: -e.log_evidence)


def _settled(best: Refit, counts: dict[str, int]) -> Explanation:
    return replace(explained(best, counts), settled=True)


def _deepest(own: Explanation, valleys: Sequence[np.ndarray], counts: dict[str, int]) -> Explanation:
    """From the constants of other valleys too."""
    best = own.refit
    hypothesis, n = best.hypothesis, best.hypothesis.constants
    tried: list[Refit] = []
    for start in [best.z, *(np.r_[v, best.z[n:]] for v in valleys)]:
        if explained(best, counts).adequacy > WELL:
            break
        rough = widened(hypothesis, start)
        if rough is None or not _is_news(rough, tried):
            continue
        tried.append(rough)
        again = through_wide_valleys(hypothesis, start, rough)
        if again is not None and again.objective < best.objective - SETTLED:
            best = again
    # models cost more than refits: another one only where the valley is another
    return own if best is own.refit else sharpened(replace(own, refit=best), leads=False)


def _is_news(rough: Refit, tried: Sequence[Refit]) -> bool:
    """Whether an optimum in wide valleys is none of those that were followed already, and not far behind them."""
    least = min((other.objective for other in tried), default=np.inf) + FAR_BEHIND
    return rough.objective < least and is_apart(rough.z, (o.z for o in tried), APART)


def _on_other_sides(optimum: Refit) -> Refit:
    """The best of refits in which constants of which little was known start far away, one at a time.

    Models of strong effects' own local fields take minutes: all are compared without these.
    """
    without = _from_there(optimum, optimum.z) if _has_own_fields(optimum) else None
    begun = without or optimum
    constants = enumerate(begun.hypothesis.study.constants.items)
    best = best_of_sides(
        Reached(begun.z, begun.objective), constants, lambda _, start: _reached(begun, start)
    )
    there = None if best.z is begun.z else _from_there(begun, best.z)
    return optimum if there is None else there


def _reached(begun: Refit, start: np.ndarray) -> Reached | None:
    """Where the refit from other constants ends: a model of its own comes from no other process."""
    found = _from_there(begun, start)
    return None if found is None else Reached(found.z, found.objective)


def _has_own_fields(found: Refit) -> bool:
    """Whether any step's basis knows the local fields of what the effects change."""
    return any(stage.examples for stage in found.hypothesis.study.stages)


def _from_there(best: Refit, start: np.ndarray) -> Refit | None:
    """The refit from other constants; what breaks the symmetry is solved there, for it does not move with them."""
    blank = replace(best.hypothesis, held=None)
    if keeps_symmetry(best):
        return refitted(blank, start, worth=best.objective)
    try:
        # Modes are not paired anew: what leads further is followed once more. The first steps from so far promise too
        # little, but not that little.
        worth = best.objective + HOPELESS
        return refit(in_its_own_model(blank, start, quick=True), start, rounds=1, worth=worth)
    except (StatorhomError, KeyError):
        return None


def keeps_symmetry(found: Refit) -> bool:
    """Whether nothing breaks the symmetry."""
    return not any(action.changes for action in found.hypothesis.actions(found.z))
