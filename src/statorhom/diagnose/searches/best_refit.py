"""The best optimum of one candidate: from its starts, straight and through wide valleys, while it can still win."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from statorhom.diagnose.fits.explanations import (
    ADEQUATE,
    WELL,
    explained,
    refitted,
    through_wide_valleys,
)
from statorhom.diagnose.fits.hypothesis import Hypothesis
from statorhom.diagnose.fits.refit import Refit, evaluated
from statorhom.diagnose.located.mirrored import at_fitting_height
from statorhom.diagnose.located.turned import at_fitting_angle
from statorhom.diagnose.processes.side_by_side import side_by_side
from statorhom.diagnose.searches.refit_starts import (
    CHEAP,
    STARTS,
    Start,
    is_poor,
    last_action,
    narrowed_starts,
    price,
    shared_by,
)
from statorhom.diagnose.searches.searched_starts import of_later_steps

MOSTLY = 0.5  # of the declared model's objective, below which an explanation leads
PROMISING = 0.6  # of the same: what explains as much without local fields is tried with them


def best_refit(starts: Sequence[Start], worth: float, *, far: bool, known: float = np.inf) -> Refit | None:
    """The best optimum of one candidate.

    Parameters
    ----------
    starts : from where.
    worth : objective above which it does not matter; then the nearest optimum is enough.
    far : whether the declared model is so far off that wide valleys come first.
    known : its objective: an effect that may be absent leaves no more, and what does is no optimum.
    """
    costs_little = price((0.0, list(starts))) == CHEAP
    cheap = far and costs_little and np.isinf(worth)
    found = _both_ways(starts) if cheap else _until_it_will_do(starts, worth, far=far, known=known)
    if not found:
        return None
    best = min(found, key=_objective)
    others: list[Refit] = []
    if cheap:
        others = beside_later_steps(best)
    elif costs_little and not far and best.objective > known:
        # beside a poor model the strongest effects are sought all over the prior in any case
        others = [] if _holds(starts[0]) else optima_elsewhere(starts[0])
    placed = at_fitting_height(at_fitting_angle(min([best, *others], key=_objective), worth), worth)
    return _whole(placed, worth)


def _both_ways(starts: Sequence[Start]) -> list[Refit]:
    """Optima from all starts, through wide valleys and straight."""
    ways = [(start, wide) for start in starts for wide in (True, False)]
    found = side_by_side(lambda way: _followed(*way), ways, shared_by(starts))
    return [r for r in found if r is not None]


def _followed(start: Start, wide: bool) -> Refit | None:
    return _through(start) if wide else refitted(start.hypothesis, start.z)


def _until_it_will_do(starts: Sequence[Start], worth: float, *, far: bool, known: float) -> list[Refit]:
    """Optima from one start after the other, until one need not be bettered."""
    found: list[Refit] = []
    for start in starts:
        if found and found[-1].objective <= known and explained(found[-1], {}).adequacy_but_one > ADEQUATE:
            break
        if np.isfinite(worth):
            found += _kept(_rival(start, worth, known))
            continue
        for wide in (True, False) if far else (False, True):
            found += _kept(_followed(start, wide))
            if found and _will_do(found[-1], known, far=far):
                break
    return found


def _whole(found: Refit, worth: float) -> Refit:
    """With what is found last."""
    if found.hypothesis.whole:
        return found
    hypothesis = replace(found.hypothesis, whole=True, held=None)
    again = refitted(hypothesis, found.z, min(found.objective, worth))
    if again is None or again.objective >= found.objective:
        return evaluated(hypothesis, found.z)
    return again


def _will_do(found: Refit, known: float, *, far: bool) -> bool:
    """Whether an optimum need not be sought the other way, straight or through wide valleys.

    On the way through wide valleys constants may leave the valley where they belonged all the time, and what explains
    most of a poor model's misfit, but not all, may have done so.
    """
    if is_poor(found) or found.objective > known:
        return False
    leads = far and found.objective < MOSTLY * known
    return not leads or explained(found, {}).adequacy_but_one > ADEQUATE


def _holds(start: Start) -> bool:
    """Whether the last effect is a support's: its stiffest one is none that is rigid, so that it may explain less."""
    return bool(last_action(start).supports)


def optima_elsewhere(start: Start) -> list[Refit]:
    """Optima all over the prior, for an effect that explains less than its absence stands in no valley of its own."""
    others = narrowed_starts(start)
    found = side_by_side(lambda other: refitted(other.hypothesis, other.z), others, shared_by(others))
    return [r for r in found if r is not None]


def beside_later_steps(best: Refit) -> list[Refit]:
    """The same effect beside other constants of later steps, where much is left to explain."""
    if explained(best, {}).adequacy_but_one > ADEQUATE:
        return []
    roughs = of_later_steps(best)[:STARTS]
    found = side_by_side(
        lambda rough: through_wide_valleys(best.hypothesis, rough.z, rough), roughs, [best.hypothesis]
    )
    return [r for r in found if r is not None]


def _objective(found: Refit) -> float:
    return found.objective


def _rival(start: Start, worth: float, known: float) -> Refit | None:
    """The nearest optimum; one that is no rival is not sought with local fields, which are dear.

    One that explains most of the declared model's objective without them may be a rival with them, and one that is
    nowhere in particular, like a stiffness that rises from end to end, explains hardly anything without.
    """
    hypothesis = start.hypothesis
    actions = hypothesis.actions(start.z)
    if not any(a.training or a.dimensions for a in actions) or is_a_field(hypothesis, start.z):
        return refitted(hypothesis, start.z, worth)
    promising = max(worth, PROMISING * known) if np.isfinite(known) else worth
    quick = refitted(replace(hypothesis, trained=False), start.z, promising)
    if quick is None or quick.objective > promising:
        return quick
    found = refitted(hypothesis, quick.z, worth)
    if found is None or explained(found, {}).adequacy > WELL:
        return found
    # without local fields a strip is deeper, or softer, than with them: from there refits may lead elsewhere
    straight = refitted(hypothesis, start.z, min(worth, found.objective))
    return min((r for r in (found, straight) if r is not None), key=_objective)


def is_a_field(hypothesis: Hypothesis, z: np.ndarray) -> bool:
    """Whether the last effect is all over its region, so that without local fields nothing of it is seen."""
    number = len(hypothesis.candidates) - 1
    return hypothesis.actions(z)[number].training is not None and not hypothesis.candidates[number].located


def _through(start: Start) -> Refit | None:
    return through_wide_valleys(start.hypothesis, start.z, start.rough)


def _kept(found: Refit | None) -> list[Refit]:
    return [] if found is None else [found]
