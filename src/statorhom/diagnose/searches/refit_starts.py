"""Where refits of the effects begin, what they cost, and in which order they are tried."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from statorhom.diagnose.fits.explanations import best_narrowed, blank, narrowed, widened
from statorhom.diagnose.fits.hypothesis import Hypothesis
from statorhom.diagnose.fits.refit import Refit
from statorhom.diagnose.fits.valleys import wide_optima
from statorhom.diagnose.fits.wider_basis import with_materials_of
from statorhom.diagnose.located.scan import Scan, Signature
from statorhom.diagnose.located.scan import starts as scan_starts
from statorhom.diagnose.processes.side_by_side import side_by_side
from statorhom.diagnose.searches.searched_starts import searched_starts
from statorhom.errors import IdentificationError
from statorhom.physics.action import Action
from statorhom.physics.candidate import Candidate

STARTS, TRIED = 2, 4  # of one candidate that are followed, and that wide valleys choose them from
PLACES = 6  # that are followed where an evaluation is cheap: a plate has more of them than a circle
WORTH = 2.0  # gain of the scan below which an effect is not refitted
POOR = 3.0  # squared residual per feature above which another valley is looked for
CHEAP, MIDDLING, DEAR = range(3)  # prices
# of the objective in wide valleys, that an effect's size costs beside its absence
UNUSUAL = 2.0
AMOUNTS = 0.3, 8.0  # that a start's magnitude is multiplied by
FIRST = 4  # cheap candidates that are followed whatever wide valleys say of them
ALIKE_CHANGE = 0.9  # of unit changes' product, from which on they are one direction
PART = 0.2  # of the best one's gain in wide valleys, from which on others are
# of the favourite's gain, from which on other effects are sought all over the prior too; how many
ALIKE, RIVALS = 0.5, 3


@dataclass(frozen=True, eq=False)
class Start:
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


Trial = tuple[float, list[Start]]  # gain of the scan, and where refits begin


def shared_by(starts: Sequence[Start]) -> list[object]:
    """What refits from there refer to (`statorhom.diagnose.processes.side_by_side`)."""
    hypotheses = [start.hypothesis for start in starts]
    return [*hypotheses, *(one for hypothesis in hypotheses for one in hypothesis.shared)]


def is_poor(found: Refit) -> bool:
    """Whether another valley should be looked for."""
    return found.misfit > POOR * len(found.jacobian)


def in_order(base: Refit, found: Scan, favourites: Sequence[Signature]) -> Iterator[Trial]:
    """Gain and starts of the candidates that are worth it, in the order in which they are tried.

    Parameters
    ----------
    base : what a candidate is added to.
    found : the scan.
    favourites : its best candidates, of which each is tried.
    """
    if not favourites:
        return
    first, *rest = favourites
    trials = [(s.gain, starts_of(base, found, s)) for s in (first, *rest)]
    if not is_poor(base):
        yield from trials
        return
    # the scan's favourite needs no rival to be tried
    begun = [trials.pop(0)] if price(trials[0]) < DEAR else []
    # gross errors are held down: what a cheap effect would gain is better tried than read from its signature
    others = [
        (s.gain, starts_of(base, found, s)) for s in found.of_every_candidate() if s not in (first, *rest)
    ]
    cheap = [trial for trial in (*trials, *others) if price(trial) == CHEAP]
    alike = _of_different_effects([trial for trial in cheap if trial[0] >= ALIKE * first.gain], first)
    widest = [trial for trial in cheap if trial not in alike]
    without = _without(base) if widest else np.inf
    searches: list[tuple[Callable[[Trial], Trial], Trial]] = [
        *((_all_over_the_prior, trial) for trial in begun),
        *((_narrowed, trial) for trial in alike),
        *((partial(_in_wide_valleys, base, without), trial) for trial in widest),
    ]
    begins = [start for _, (_, starts) in searches for start in starts]
    searched = side_by_side(lambda search: search[0](search[1]), searches, shared_by(begins))
    near = len(begun) + len(alike)
    yield from searched[:near]
    yield from _promising(without, searched[near:])
    yield from sorted((trial for trial in trials if price(trial) > CHEAP), key=price)


def _all_over_the_prior(trial: Trial) -> Trial:
    gain, starts = trial
    return gain, [*(searched(starts[0]) if price(trial) == CHEAP else ()), *starts]


def _narrowed(trial: Trial) -> Trial:
    gain, starts = trial
    return gain, [*narrowed_starts(starts[0]), *starts]


def _in_wide_valleys(base: Refit, without: float, trial: Trial) -> Trial:
    """With starts in wide valleys; what explains less there than its absence is sought all over the prior."""
    gain, starts = trial
    begun = _through_sizes(base.z, starts)
    if begun[0].rough is None or begun[0].rough.objective <= without + UNUSUAL:
        return gain, begun
    return gain, [*narrowed_starts(starts[0]), *begun]


def _without(base: Refit) -> float:
    """What is left without another effect, in wide valleys."""
    found = widened(blank(base.hypothesis, base.hypothesis.candidates), base.z)
    return np.inf if found is None else found.objective


def _of_different_effects(trials: Sequence[Trial], first: Signature) -> list[Trial]:
    """The first trial of each step's effect but the favourite's, as many as are worth it."""
    found: dict[tuple[str, str], Trial] = {}
    for trial in trials:
        candidate = trial[1][0].hypothesis.candidates[-1]
        found.setdefault((candidate.effect, candidate.stage), trial)
    found.pop((first.candidate.effect, first.candidate.stage), None)
    return list(found.values())[:RIVALS]


def last_action(start: Start) -> Action:
    """What the candidate does; after it stands what the study declares."""
    return start.hypothesis.actions(start.z)[len(start.hypothesis.candidates) - 1]


def price(trial: Trial) -> int:
    """What an evaluation costs: least where the symmetry is kept, most with a contact that is lost over an arc."""
    _, (start, *_) = trial
    # what the candidate is added to costs the same with each of them
    return price_of(last_action(start))


def price_of(action: Action) -> int:
    """The same with what one candidate does."""
    if action.joint is not None and action.joint.arc is not None:
        return DEAR
    return CHEAP if action.changes is None else MIDDLING


def _promising(without: float, trials: Sequence[Trial]) -> list[Trial]:
    """Those that wide valleys like, the best first: the first few, and what gains a part of what the best one does.

    After them what was sought in narrower ones, of which wide valleys say nothing.
    """

    def rough(trial: Trial) -> float:
        return min(_rough_objective(start) for start in trial[1])

    sought = [trial for trial in trials if trial[1][0].rough is None and np.isfinite(rough(trial))]
    ordered = sorted((trial for trial in trials if trial not in sought), key=rough)
    if np.isinf(without) or not ordered:
        return [*ordered, *sought]
    least = PART * (without - rough(ordered[0]))
    liked = [t for i, t in enumerate(ordered) if i < FIRST or without - rough(t) >= least]
    return [*liked, *sought]


def starts_of(base: Refit, found: Scan, signature: Signature) -> list[Start]:
    """The best starts of a candidate that are not neighbours, and those of its other magnitudes."""
    own = [s for s in found.signatures if s.candidate.label == signature.candidate.label]
    chosen: list[Signature] = []
    for one in own:
        if not any(_neighbours(one, other) for other in chosen):
            chosen.append(one)
    begun = [_begun(base, s) for s in chosen[:PLACES]]
    if not signature.candidate.located or price((signature.gain, begun)) != CHEAP:
        begun = begun[:STARTS]
    if not is_poor(base):
        return begun
    every = [np.r_[base.z, start] for start in scan_starts(base.hypothesis.study, signature.candidate)]
    wider = with_materials_of(begun[0].hypothesis, every)
    return [replace(one, hypothesis=wider) for one in begun]


def _neighbours(one: Signature, other: Signature) -> bool:
    """Whether refits from two starts of a candidate lead to the same optimum.

    Splits of a table have no sign: a stiffer strip parts doublets like a softer one while it is weak.
    """
    alike = abs(float(one.change @ other.change)) >= ALIKE_CHANGE
    return alike and _side(one) == _side(other)


def _side(signature: Signature) -> tuple[bool, ...]:
    """Of what each magnitude has where the effect is absent, whether the start lies above."""
    pairs = zip(signature.candidate.parameters, signature.start, strict=True)
    return tuple(p.value(float(z)) > p.absent for p, z in pairs if p.absent is not None and not p.located)


def _begun(base: Refit, signature: Signature) -> Start:
    """A start of a candidate, of the size that the misfit asks for.

    An arc of lost contact is not made wider: from narrow ones refits reach wide ones, from too wide ones no others.
    """
    as_scanned = start_of(base, signature.candidate, signature.start)
    if price((signature.gain, [as_scanned])) == DEAR:
        return as_scanned
    return start_of(base, signature.candidate, _as_large(signature))


def _as_large(signature: Signature) -> np.ndarray:
    """The start of an effect somewhere, about as large as the misfit asks for: lumps differ by a factor of fifty."""
    magnitude, *others = signature.candidate.parameters
    if not any(p.located for p in others):
        return signature.start
    value, amount = magnitude.value(signature.start[0]), float(np.clip(signature.amount, *AMOUNTS))
    if magnitude.scale == "log":
        absent = magnitude.absent
        value = value * amount if absent is None else absent * (value / absent) ** amount
    start = signature.start.copy()
    start[0] = magnitude.internal(float(np.clip(value, magnitude.lower, magnitude.upper)))
    return start


def start_of(base: Refit, candidate: Candidate, start: np.ndarray) -> Start:
    hypothesis = blank(base.hypothesis, (*base.hypothesis.candidates, candidate))
    whole = not any(p.last for p in candidate.parameters)
    return Start(replace(hypothesis, whole=whole), np.r_[base.z, start])


def cheap_starts(base: Refit, candidates: Sequence[Candidate]) -> list[Start]:
    """The first start of every candidate to whose magnitudes neither solutions nor meshes nor supports belong."""
    return [start for c in candidates if c.parameters and _costs_little(start := first_start(base, c))]


def first_start(base: Refit, candidate: Candidate) -> Start:
    """The first one that the scan would look at."""
    return start_of(base, candidate, scan_starts(base.hypothesis.study, candidate)[0])


def _costs_little(start: Start) -> bool:
    action = last_action(start)
    return price((0.0, [start])) == CHEAP and not action.dimensions and not action.supports


def searched(start: Start) -> list[Start]:
    """Starts at the best optima that are found all over the prior, in wide valleys."""
    found = searched_starts(start.hypothesis, start.z)[:STARTS]
    return [replace(start, z=rough.z, rough=rough) for rough in found]


def narrowed_starts(start: Start) -> list[Start]:
    """Starts at optima all over the prior in narrower valleys, for what will be sought from there straight away."""
    rough = [s.rough for s in searched(start) if s.rough is not None]
    return [replace(start, z=found.z) for found in side_by_side(narrowed, rough, [start.hypothesis])]


def best_of_sizes(start: Start) -> Refit | None:
    """The best optimum that any of a candidate's magnitudes leads to from the constants of a start."""
    constants = start.z[: -len(start.hypothesis.candidates[-1].parameters)]
    wide = [s.rough for s in _through_sizes(constants, [start]) if s.rough is not None]
    return best_narrowed(start.hypothesis, wide)


def _through_sizes(constants: np.ndarray, starts: list[Start]) -> list[Start]:
    """Starts at the best optima in wide valleys that are found from all of a cheap candidate's magnitudes.

    Parameters
    ----------
    constants : what the candidate stands beside, with what other effects have of parameters.
    """
    hypothesis = starts[0].hypothesis
    every = scan_starts(hypothesis.study, hypothesis.candidates[-1])
    points = [*(start.z for start in starts), *(np.r_[constants, one] for one in every)]
    try:
        found = wide_optima(replace(hypothesis, trained=False), points, TRIED)[:STARTS]
    except IdentificationError:
        return starts
    return [Start(hypothesis, rough.z, rough) for rough in found]


def _rough_objective(start: Start) -> float:
    return np.inf if start.rough is None else start.rough.objective
