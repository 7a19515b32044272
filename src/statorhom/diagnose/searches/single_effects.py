"""The best explanation by every effect: what is cheap first, the rest only as far as it can still win.

What breaks no symmetry is refitted in a fraction of a second, a contact takes half a minute. Where the declared model
is far off, the cheap candidates go first in the order in which wide valleys like them. As soon as one leaves nothing
to explain, the others are followed only while they promise to come near it.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np

from statorhom.diagnose.evidence.decision import OVER_OTHERS, least_over_nothing
from statorhom.diagnose.fits.explanations import (
    ADEQUATE,
    WELL,
    Explanation,
    best_of_each,
    explained,
    nothing,
    refitted,
    through_wide_valleys,
)
from statorhom.diagnose.fits.hypothesis import Hypothesis
from statorhom.diagnose.fits.refit import Refit, evaluated
from statorhom.diagnose.located.mirrored import at_fitting_height
from statorhom.diagnose.located.scan import Scan
from statorhom.diagnose.located.turned import at_fitting_angle
from statorhom.diagnose.processes.side_by_side import side_by_side
from statorhom.diagnose.searches.from_the_best import from_the_best
from statorhom.diagnose.searches.mislabelled import worth_trying
from statorhom.diagnose.searches.other_machines import on_other_machines
from statorhom.diagnose.searches.own_machine import from_its_own_machine
from statorhom.diagnose.searches.refit_starts import (
    CHEAP,
    DEAR,
    STARTS,
    WORTH,
    Start,
    Trial,
    in_order,
    is_poor,
    last_action,
    narrowed_starts,
    price,
    shared_by,
    start_of,
)
from statorhom.diagnose.searches.searched_starts import of_later_steps
from statorhom.physics.candidate import Candidate

MOST = 12  # candidates that are refitted
RELABELLED = 4
TOGETHER = 4  # refits that know of the same others
NEARLY = 0.1  # of the declared model's objective, that is left where a cause has been found
MOSTLY = 0.5  # of the declared model's objective, below which an explanation leads
PROMISING = 0.6  # of the same: what explains as much without local fields is tried with them
NEAR = 60.0  # of the objective: what does not come so near to an adequate explanation is given up


def single_effects(
    base: Refit, found: Scan, discrete: Sequence[Candidate], counts: dict[str, int]
) -> list[Explanation]:
    """Refits of the most promising candidates of every effect, the best first.

    Parameters
    ----------
    base : the declared model's optimum.
    found : the scan.
    discrete : candidates without parameters.
    counts : effect → number of its candidates, over which its prior is spread.
    """
    favourites = found.worth_refitting(MOST, WORTH, nothing(base).adequacy < ADEQUATE)
    near, dear = _until_the_last_cheap(list(in_order(base, found, favourites)))
    tried = refits(base, near, counts)
    if _leaves_rows(nothing(base), *tried):
        starts = [start_of(base, s.candidate, s.start) for s in found.of_every_candidate()]
        tried += [explained(r, counts) for r in on_other_machines(base, starts, _beside_later_steps)]
    tried = refits(base, dear, counts, known=list(best_of_each(tried).values()))
    explanations = from_the_best(base, found, tried, counts)
    explanations += new_names(base, discrete, counts, _worth(explanations))
    return sorted(explanations, key=lambda e: -e.log_evidence)


def _leaves_rows(*explanations: Explanation) -> bool:
    """Whether each of some explanations leaves more than noise, if only one row that another machine would meet."""
    return all(e.adequacy <= ADEQUATE for e in explanations)


def _until_the_last_cheap(trials: Sequence[Trial]) -> tuple[Sequence[Trial], Sequence[Trial]]:
    """Trials up to the last one that costs little, and the others."""
    end = max((i + 1 for i, trial in enumerate(trials) if price(trial) == CHEAP), default=0)
    return trials[:end], trials[end:]


def refits(
    base: Refit,
    trials: Iterable[Trial],
    counts: dict[str, int],
    limit: float = np.inf,
    known: Sequence[Explanation] = (),
) -> list[Explanation]:
    """The best refit of every trial that can still win, and what is known already.

    Parameters
    ----------
    base : what the trials add to.
    trials : in the order in which they are tried.
    counts : as for `single_effects`.
    limit : objective above which a refit matters to nobody; what costs little beside a poor model, and what has no
        place beside a good one, is followed whatever it reaches at once, for other valleys may be better.
    known : explanations that the trials have to rival.
    """
    explanations = list(known)
    waiting = list(trials)
    while waiting:
        # whatever the number of processes, so that answers do not depend on it
        count = TOGETHER if explanations else 1
        now, waiting = waiting[:count], waiting[count:]
        limits = [_limit(base, trial, explanations, limit) for trial in now]
        tasks = [(starts, worth) for (_, starts), worth in zip(now, limits, strict=True) if worth is not None]
        found = side_by_side(
            lambda task: _best_refit(*task, far=is_poor(base), known=base.objective),
            tasks,
            shared_by([start for starts, _ in tasks for start in starts]),
        )
        # machines that are solved are kept where all later refits find them
        explanations += [
            explained(from_its_own_machine(best, base.objective, _beside_later_steps), counts)
            for best in found
            if best is not None
        ]
    return explanations


def _limit(base: Refit, trial: Trial, explanations: Sequence[Explanation], limit: float) -> float | None:
    """Objective above which a trial's refit is no rival; None where it need not be made."""
    gain, starts = trial
    dear, placed = price(trial) > CHEAP, _has_place(starts[0])
    limited = dear if is_poor(base) else placed
    # what costs little may explain the one row too that another leaves: that one is no limit to it
    whole = not (dear or placed or _explains_nearly_all(base, explanations))
    bar = _worth(explanations, whole=whole)
    if np.isfinite(bar):
        bar = min(bar, _least_of_a_rival(base))
    worth = min(bar, limit if limited else np.inf)
    if gain < WORTH and np.isfinite(worth):
        return None  # it promises nothing, and nothing is left to explain
    return min(worth, _leading(base, explanations)) if dear else worth


def _has_place(start: Start) -> bool:
    """Whether the last effect is somewhere, or loses contact somewhere: its refits take many solutions."""
    return price((0.0, [start])) == DEAR or start.hypothesis.candidates[-1].located


def new_names(
    base: Refit, discrete: Sequence[Candidate], counts: dict[str, int], worth: float = np.inf
) -> list[Explanation]:
    """Refits of the most promising candidates without parameters, the best first.

    Parameters
    ----------
    base, discrete, counts : as for `single_effects`.
    worth : objective above which an explanation is no rival.
    """
    found = [
        explained(best, counts)
        for candidate in worth_trying(base, discrete)[:RELABELLED]
        if (best := _best_refit([start_of(base, candidate, np.empty(0))], worth, far=False)) is not None
    ]
    return sorted(found, key=lambda e: -e.log_evidence)


def _worth(explanations: Sequence[Explanation], *, whole: bool = False) -> float:
    """Objective above which a further explanation is no rival; infinite while nothing explains the misfit.

    Parameters
    ----------
    whole : whether it has to explain the worst row too.
    """
    chances = [e.adequacy if whole else e.adequacy_but_one for e in explanations]
    pairs = zip(explanations, chances, strict=True)
    return min((e.refit.objective for e, p in pairs if p > ADEQUATE), default=np.inf) + NEAR


def _least_of_a_rival(base: Refit) -> float:
    """Objective above which an explanation is no rival even of what leads by as little as is asked for."""
    least = least_over_nothing(nothing(base).adequacy)
    return base.objective - 2 * (least - OVER_OTHERS)


def _explains_nearly_all(base: Refit, explanations: Sequence[Explanation]) -> bool:
    """Whether what leads leaves hardly anything of a poor model's misfit: the one row that it leaves is an error."""
    return _least(explanations) < NEARLY * base.objective


def _leading(base: Refit, explanations: Sequence[Explanation]) -> float:
    """The same for what is dear, where a cheap effect explains most of the misfit: it leads, adequate or not."""
    best = _least(explanations)
    return best + NEAR if best < MOSTLY * base.objective else np.inf


def _least(explanations: Sequence[Explanation]) -> float:
    """Objective of what leaves least."""
    return min((e.refit.objective for e in explanations), default=np.inf)


def _best_refit(starts: Sequence[Start], worth: float, *, far: bool, known: float = np.inf) -> Refit | None:
    """The best optimum of one candidate.

    Parameters
    ----------
    starts : from where.
    worth : objective above which it does not matter; then the nearest optimum is enough.
    far : whether the declared model is so far off that wide valleys come first.
    known : its objective: an effect that may be absent leaves no more, and what does is no optimum.
    """
    found: list[Refit] = []
    costs_little = price((0.0, list(starts))) == CHEAP
    cheap = far and costs_little and np.isinf(worth)
    for start in starts:
        less = bool(found) and found[-1].objective <= known
        if less and not cheap and explained(found[-1], {}).adequacy_but_one > ADEQUATE:
            break
        if np.isfinite(worth):
            found += _kept(_rival(start, worth, known))
            continue
        for wide in (True, False) if far else (False, True):
            found += _kept(_through(start) if wide else refitted(start.hypothesis, start.z))
            if found and not cheap and _will_do(found[-1], known, far=far):
                break
    best = min(found, key=_objective, default=None)
    others: list[Refit] = []
    if best is not None and cheap:
        others = _beside_later_steps(best)
    elif best is not None and costs_little and not far and best.objective > known:
        # beside a poor model the strongest effects are sought all over the prior in any case
        others = [] if _holds(starts[0]) else optima_elsewhere(starts[0])
    if best is None:
        return None
    placed = at_fitting_height(at_fitting_angle(min([best, *others], key=_objective), worth), worth)
    return _whole(placed, worth)


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
    found = (refitted(other.hypothesis, other.z) for other in narrowed_starts(start))
    return [r for r in found if r is not None]


def _beside_later_steps(best: Refit) -> list[Refit]:
    """The same effect beside other constants of later steps, where much is left to explain."""
    if explained(best, {}).adequacy_but_one > ADEQUATE:
        return []
    roughs = of_later_steps(best)[:STARTS]
    found = (through_wide_valleys(best.hypothesis, rough.z, rough) for rough in roughs)
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
