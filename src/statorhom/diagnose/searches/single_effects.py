"""The best explanation by every effect: what is cheap first, the rest only as far as it can still win.

What breaks no symmetry is refitted in a fraction of a second, a contact takes half a minute. Where the declared model
is far off, the cheap candidates go first in the order in which wide valleys like them. As soon as one leaves nothing
to explain, the others are followed only while they promise to come near it.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from statorhom.diagnose.evidence.decision import OVER_OTHERS, least_over_nothing
from statorhom.diagnose.fits.explanations import (
    ADEQUATE,
    Explanation,
    best_of_each,
    explained,
    nothing,
)
from statorhom.diagnose.fits.refit import Refit
from statorhom.diagnose.located.scan import Scan
from statorhom.diagnose.processes.side_by_side import side_by_side
from statorhom.diagnose.searches.best_refit import MOSTLY, beside_later_steps, best_refit
from statorhom.diagnose.searches.from_the_best import from_the_best
from statorhom.diagnose.searches.mislabelled import worth_trying
from statorhom.diagnose.searches.other_machines import on_other_machines
from statorhom.diagnose.searches.own_machine import from_its_own_machine
from statorhom.diagnose.searches.refit_starts import (
    CHEAP,
    DEAR,
    WORTH,
    Start,
    Trial,
    in_order,
    is_poor,
    price,
    shared_by,
    start_of,
)
from statorhom.physics.candidate import Candidate

MOST = 12  # candidates that are refitted
RELABELLED = 4
TOGETHER = 4  # refits that know of the same others
NEARLY = 0.1  # of the declared model's objective, that is left where a cause has been found
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
        tried += [explained(r, counts) for r in on_other_machines(base, starts, beside_later_steps)]
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
        count = _together(waiting) if explanations else 1
        now, waiting = waiting[:count], waiting[count:]
        limits = [_limit(base, trial, explanations, limit) for trial in now]
        tasks = [(starts, worth) for (_, starts), worth in zip(now, limits, strict=True) if worth is not None]
        found = side_by_side(
            lambda task: best_refit(*task, far=is_poor(base), known=base.objective),
            tasks,
            shared_by([start for starts, _ in tasks for start in starts]),
        )
        # machines that are solved are kept where all later refits find them
        explanations += [
            explained(from_its_own_machine(best, base.objective, beside_later_steps), counts)
            for best in found
            if best is not None
        ]
    return explanations


def _together(waiting: Sequence[Trial]) -> int:
    """How many of the next trials know of the same others; what costs more and promises nothing waits for the rest."""
    chosen = waiting[:TOGETHER]
    idle = [gain < WORTH and price((gain, starts)) > CHEAP for gain, starts in chosen]
    first = idle.index(True) if True in idle else 0
    return first or len(chosen)


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
        if (best := best_refit([start_of(base, candidate, np.empty(0))], worth, far=False)) is not None
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
