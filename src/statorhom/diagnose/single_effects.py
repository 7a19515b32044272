"""The best explanation by every effect: what is cheap first, the rest only as far as it can still win.

What breaks no symmetry is refitted in a fraction of a second, a contact takes half a minute. Where the declared model
is far off, the cheap candidates go first in the order in which wide valleys like them. As soon as one leaves nothing
to explain, the others are followed only while they promise to come near it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from statorhom.diagnose.explanations import (
    ADEQUATE,
    Explanation,
    blank,
    explained,
    nothing,
    refitted,
    through_wide_valleys,
    widened,
)
from statorhom.diagnose.hypothesis import Hypothesis
from statorhom.diagnose.mislabelled import worth_trying
from statorhom.diagnose.refit import Refit
from statorhom.diagnose.scan import Scan, Signature
from statorhom.diagnose.scan import starts as scan_starts
from statorhom.diagnose.searched_starts import searched_starts
from statorhom.diagnose.valleys import wide_optima
from statorhom.diagnose.wider_basis import with_materials_of
from statorhom.errors import IdentificationError
from statorhom.physics.candidate import Candidate

STARTS, TRIED = 2, 4  # of one candidate that are followed, and that wide valleys choose them from
WORTH = 2.0  # gain of the scan below which an effect is not refitted
MOST = 12  # candidates that are refitted
RELABELLED = 4
POOR = 3.0  # squared residual per feature above which another valley is looked for
CHEAP, MIDDLING, DEAR = range(3)  # prices
FIRST = 4  # cheap candidates that are followed whatever wide valleys say of them
PART = 0.2  # of the best one's gain in wide valleys, from which on others are
MOSTLY = 0.5  # of the declared model's objective, below which an explanation leads
NEAR = 60.0  # of the objective: what does not come so near to an adequate explanation is given up


@dataclass(frozen=True, eq=False)
class _Start:
    """Where a candidate's refit begins.

    Parameters
    ----------
    hypothesis : the declared model and the candidate.
    z : all coordinates.
    rough : the optimum in wide valleys, where that is known.
    """

    hypothesis: Hypothesis
    z: np.ndarray
    rough: Refit | None = None


_Trial = tuple[float, list[_Start]]  # gain of the scan, and where refits begin


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
    explanations: list[Explanation] = []
    for gain, starts in _in_order(base, found):
        worth = _worth(explanations)
        if gain < WORTH and np.isfinite(worth):
            continue  # it promises nothing, and nothing is left to explain
        if _price((gain, starts)) > CHEAP:
            worth = min(worth, _leading(base, explanations))
        best = _best_refit(starts, worth, far=is_poor(base))
        if best is not None:
            explanations.append(explained(best, counts))
    explanations += new_names(base, discrete, counts, _worth(explanations))
    return sorted(explanations, key=lambda e: -e.log_evidence)


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
        if (best := _best_refit([_start(base, candidate, np.empty(0))], worth, far=False)) is not None
    ]
    return sorted(found, key=lambda e: -e.log_evidence)


def is_poor(found: Refit) -> bool:
    """Whether another valley should be looked for."""
    return found.misfit > POOR * len(found.jacobian)


def _worth(explanations: Sequence[Explanation]) -> float:
    """Objective above which a further explanation is no rival; infinite while nothing explains the misfit."""
    adequate = [e.refit.objective for e in explanations if e.adequacy > ADEQUATE]
    return min(adequate, default=np.inf) + NEAR


def _leading(base: Refit, explanations: Sequence[Explanation]) -> float:
    """The same for what is dear, where a cheap effect explains most of the misfit: it leads, adequate or not."""
    best = min((e.refit.objective for e in explanations), default=np.inf)
    return best + NEAR if best < MOSTLY * base.objective else np.inf


def _in_order(base: Refit, found: Scan) -> Iterator[_Trial]:
    """Gain and starts of the candidates that are worth it, in the order in which they are tried."""
    first, *rest = found.worth_refitting(MOST, WORTH, nothing(base).adequacy < ADEQUATE) or (None,)
    if first is None:
        return
    trials = [(s.gain, _starts_of(base, found, s)) for s in (first, *rest)]
    if not is_poor(base):
        yield from trials
        return
    if _price(trials[0]) < DEAR:
        # the scan's favourite needs no rival to be tried
        gain, starts = trials.pop(0)
        yield gain, [*(_searched(starts[0]) if _price((gain, starts)) == CHEAP else ()), *starts]
    # gross errors are held down: what a cheap effect would gain is better tried than read from its signature
    others = [
        (s.gain, _starts_of(base, found, s)) for s in found.of_every_candidate() if s not in (first, *rest)
    ]
    cheap = [trial for trial in (*trials, *others) if _price(trial) == CHEAP]
    widest = [(gain, _with_rough(base, starts)) for gain, starts in cheap]
    yield from _promising(base, widest)
    yield from sorted((trial for trial in trials if _price(trial) > CHEAP), key=_price)


def _promising(base: Refit, trials: Sequence[_Trial]) -> list[_Trial]:
    """Those that wide valleys like, the best first: the first few, and what gains a part of what the best one does."""

    def rough(trial: _Trial) -> float:
        return min(_rough_objective(start) for start in trial[1])

    ordered = sorted(trials, key=rough)
    declared = widened(blank(base.hypothesis, ()), base.z)
    if declared is None or not ordered:
        return ordered
    least = PART * (declared.objective - rough(ordered[0]))
    return [t for i, t in enumerate(ordered) if i < FIRST or declared.objective - rough(t) >= least]


def _starts_of(base: Refit, found: Scan, signature: Signature) -> list[_Start]:
    """The best starts of a candidate that are not neighbours, and those of its other magnitudes."""
    own = [s for s in found.signatures if s.candidate.label == signature.candidate.label]
    chosen: list[Signature] = []
    for one in own:
        if all(abs(float(one.change @ other.change)) < 0.9 for other in chosen):
            chosen.append(one)
    begun = [_start(base, s.candidate, s.start) for s in chosen[:STARTS]]
    if not is_poor(base):
        return begun
    every = [np.r_[base.z, start] for start in scan_starts(base.hypothesis.study, signature.candidate)]
    wider = with_materials_of(begun[0].hypothesis, every)
    return [replace(one, hypothesis=wider) for one in begun]


def _start(base: Refit, candidate: Candidate, start: np.ndarray) -> _Start:
    hypothesis = blank(base.hypothesis, (candidate,))
    return _Start(hypothesis, np.r_[base.z, start])


def _searched(start: _Start) -> list[_Start]:
    """Starts at the best optima that are found all over the prior, in wide valleys."""
    found = searched_starts(start.hypothesis, start.z)[:STARTS]
    return [replace(start, z=rough.z, rough=rough) for rough in found]


def _with_rough(base: Refit, starts: list[_Start]) -> list[_Start]:
    """Starts at the best optima in wide valleys that are found from all of a cheap candidate's magnitudes."""
    hypothesis = starts[0].hypothesis
    every = scan_starts(base.hypothesis.study, hypothesis.candidates[0])
    points = [*(start.z for start in starts), *(np.r_[base.z, one] for one in every)]
    try:
        found = wide_optima(replace(hypothesis, trained=False), points, TRIED)[:STARTS]
    except IdentificationError:
        return starts
    return [_Start(hypothesis, rough.z, rough) for rough in found]


def _rough_objective(start: _Start) -> float:
    return np.inf if start.rough is None else start.rough.objective


def _price(trial: _Trial) -> int:
    """What an evaluation costs: least where the symmetry is kept, most with a contact."""
    _, (start, *_) = trial
    action = start.hypothesis.actions(start.z)[0]
    if action.joint is not None:
        return DEAR
    return CHEAP if action.changes is None else MIDDLING


def _best_refit(starts: Sequence[_Start], worth: float, *, far: bool) -> Refit | None:
    """The best optimum of one candidate.

    Parameters
    ----------
    starts : from where.
    worth : objective above which it does not matter; then the nearest optimum is enough.
    far : whether the declared model is so far off that wide valleys come first.
    """
    found: list[Refit] = []
    for start in starts:
        if found and explained(found[-1], {}).adequacy > ADEQUATE:
            break
        if np.isfinite(worth):
            found += _kept(_rival(start, worth))
            continue
        for wide in (True, False) if far else (False, True):
            found += _kept(_through(start) if wide else refitted(start.hypothesis, start.z))
            if found and not is_poor(found[-1]):
                break
    return min(found, key=lambda r: r.objective, default=None)


def _rival(start: _Start, worth: float) -> Refit | None:
    """The nearest optimum; one that is no rival is not sought with local fields, which are dear."""
    hypothesis = start.hypothesis
    if any(action.training or action.dimensions for action in hypothesis.actions(start.z)):
        quick = refitted(replace(hypothesis, trained=False), start.z, worth)
        if quick is None or quick.objective > worth:
            return quick
        start = replace(start, z=quick.z)
    return refitted(hypothesis, start.z, worth)


def _through(start: _Start) -> Refit | None:
    return through_wide_valleys(start.hypothesis, start.z, start.rough)


def _kept(found: Refit | None) -> list[Refit]:
    return [] if found is None else [found]
