"""The optima of the declared model: many points of the prior tried in wide valleys, the best of them sharpened."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from functools import partial
from typing import NamedTuple, Protocol

import numpy as np
from scipy.stats import norm, qmc
from typing_extensions import TypeVar

from statorhom.diagnose.fits.any_hypothesis import AnyHypothesis
from statorhom.diagnose.fits.explanations import COARSE, refitted
from statorhom.diagnose.fits.refit import Refit, refit_objective
from statorhom.diagnose.processes.side_by_side import side_by_side
from statorhom.diagnose.stages.constants import Constant
from statorhom.errors import IdentificationError, StatorhomError

_H = TypeVar("_H", bound=AnyHypothesis)

# points that are tried, refitted in wide valleys, and sharpened
TRIALS, STARTS, SHARPENED = 200, 16, 3
# how many are refitted while all of them miss frequencies by more than a part of what wide valleys forgive
MOST, FITTING = 48, 0.25
MANY = 24  # points that are worth a process
# prior standard deviations between starts, and between optima: of two in one wide valley a narrow one may be right
APART, DIFFERENT = 1.0, 0.5
ALIKE = 5.0  # of the objective in wide valleys, between which there is nothing to choose
FAR_BEHIND = 20.0  # of the objective in wide valleys: what stays so far behind is no other optimum
VAGUE = 1.0  # prior standard deviations of a logarithm from which on a constant may be far on either side
ASIDE = 1.5  # prior standard deviations to either side where such a constant is tried
SETTLED = 2.0  # of the objective, that another optimum must have gained
NO_START = "no start of the declared model could be fitted; check masses and tables"
SPREAD = 1.1  # of the prior: how far materials to try lie apart


def trials_around(z: np.ndarray, places: Sequence[int], seed: int) -> list[np.ndarray]:
    """The prior's median and points around it, in the new constants alone."""
    found = [z]
    if places:
        cube = qmc.LatinHypercube(len(places), seed=seed).random(TRIALS)
        for row in over_the_prior(cube):
            point = z.copy()
            point[list(places)] = row
            found.append(point)
    return found


def over_the_prior(parts: np.ndarray) -> np.ndarray:
    """Coordinates for parts (0 … 1) of the prior, its ends left out."""
    return np.asarray(SPREAD * norm.ppf(0.02 + 0.96 * parts))


def optima(blank: _H, trials: Sequence[np.ndarray]) -> list[Refit[_H]]:
    """Different optima, the best first: found in wide valleys, then sharpened.

    Parameters
    ----------
    blank : the declared model.
    trials : points to begin from.

    Raises
    ------
    IdentificationError
        If no point could be fitted.
    """
    wide = wide_optima(blank, trials)
    found = [r for w in wide[:SHARPENED] if (r := refitted(blank, w.z)) is not None]
    if not found:
        raise IdentificationError(NO_START)
    return different(found)


def wide_optima(
    blank: _H, trials: Sequence[np.ndarray], starts: int = STARTS, most: int | None = None
) -> list[Refit[_H]]:
    """Different optima in wide valleys, the best first; for those who do not know yet what the mesh is wrong by.

    Parameters
    ----------
    blank, trials : as for `optima`.
    starts, most : number of points that are refitted, and at most where none of them fits.

    Raises
    ------
    IdentificationError
        If no point could be fitted.
    """
    coarse = replace(blank, discrepancy=COARSE)
    found: list[Refit[_H]] = []
    for number, z in enumerate(apart(nearest_first(coarse, trials), most or starts)):
        if number >= starts and any(_fits(r) for r in found):
            break
        # what promises nothing beside the best so far is not followed
        worth = min((r.objective for r in found), default=np.inf) + FAR_BEHIND
        found += [r] if (r := refitted(coarse, z, worth)) is not None else []
    if not found:
        raise IdentificationError(NO_START)
    return different(found)


def with_other_sides(blank: _H, wide: Sequence[Refit[_H]], places: Sequence[int]) -> list[Refit[_H]]:
    """Optima in wide valleys and a deeper one, if there is one on other sides of some constants; the best first.

    Two hundred points leave most of the corners of five constants out: the best of them may lie in a valley that
    strains the prior of one that hardly matters there.

    Parameters
    ----------
    blank : the declared model.
    wide : optima in wide valleys, the best first.
    places : of the constants that are tried, where little is known of them.
    """
    coarse = replace(blank, discrepancy=COARSE)
    best = on_its_best_side(wide[0], coarse, places)
    return different([best, *wide]) if best is not wide[0] else list(wide)


def on_its_best_side(best: Refit[_H], blank: _H, places: Iterable[int]) -> Refit[_H]:
    """The best of an optimum and what refits find on other sides of some constants, without models of their own.

    Parameters
    ----------
    best : the optimum.
    blank : what is refitted, to be paired anew.
    places : of the constants that are tried, where little is known of them.
    """
    constants = [(place, blank.study.constants.items[place]) for place in places]
    shared = [blank, *blank.shared]
    return best_of_sides(best, constants, lambda r, start: refitted(blank, start, r.objective), shared)


class Reached(NamedTuple):
    """Where a refit ended, without its models."""

    z: np.ndarray
    objective: float


class _Optimum(Protocol):
    @property
    def z(self) -> np.ndarray: ...
    @property
    def objective(self) -> float: ...


_Found = TypeVar("_Found", bound=_Optimum)


def best_of_sides(
    best: _Found,
    constants: Iterable[tuple[int, Constant]],
    follow: Callable[[_Found, np.ndarray], _Found | None],
    shared: Sequence[object] = (),
) -> _Found:
    """The best of an optimum and what is found where a constant of which little is known starts far to either side.

    Parameters
    ----------
    best : the optimum.
    constants : their places and themselves, which are tried one after the other, both sides at once.
    follow : the best optimum so far and a start → the optimum from there.
    shared : what the optima may refer to (`statorhom.diagnose.processes.side_by_side`).
    """
    for place, constant in constants:
        if not constant.log or constant.sd < VAGUE:
            continue
        starts = [best.z.copy() for _ in range(2)]
        for start, side in zip(starts, (-ASIDE, ASIDE), strict=True):
            start[place] = side
        for again in side_by_side(partial(follow, best), starts, shared):
            if again is not None and again.objective < best.objective - SETTLED:
                best = again
    return best


def nearest_first(hypothesis: AnyHypothesis, points: Sequence[np.ndarray]) -> list[np.ndarray]:
    """Points by what a refit would have to make small there; what no body has is left out."""
    scores = side_by_side(partial(_score, hypothesis), points, least=MANY)
    scored = [(score, z) for score, z in zip(scores, points, strict=True) if score is not None]
    return [z for _, z in sorted(scored, key=lambda pair: pair[0])]


def _score(hypothesis: AnyHypothesis, z: np.ndarray) -> float | None:
    try:
        return refit_objective(hypothesis, z)
    except StatorhomError:
        return None


def _fits(found: Refit[_H]) -> bool:
    """Whether what is left in wide valleys is less than another optimum may leave."""
    return found.misfit < FITTING * len(found.jacobian)


def different(
    found: Sequence[Refit[_H]], where: Callable[[Refit[_H]], np.ndarray] = lambda r: r.z
) -> list[Refit[_H]]:
    """Optima that are no neighbours of better ones, the best first; `where` tells the coordinates that count."""
    chosen: list[Refit[_H]] = []
    for r in sorted(found, key=lambda r: r.objective):
        if is_apart(where(r), map(where, chosen), DIFFERENT):
            chosen.append(r)
    return chosen


def is_apart(z: np.ndarray, others: Iterable[np.ndarray], least: float) -> bool:
    """Whether a point is no neighbour of others, in prior standard deviations."""
    return all(np.linalg.norm(z - other) > least for other in others)


def apart(points: Sequence[np.ndarray], most: int) -> list[np.ndarray]:
    """The first points that are no neighbours of better ones."""
    chosen: list[np.ndarray] = []
    for z in points:
        if len(chosen) < most and is_apart(z, chosen, APART):
            chosen.append(z)
    return chosen
