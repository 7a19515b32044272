"""Arcs of lost contact, sought beside windings all over the prior, or like one that is known.

A contact that is lost over a wide arc lets much of the winding go, and few frequencies tell how stiff the rest is:
there are many valleys nearly as deep. In bases that know two such arcs, and in the few vectors that matter there,
thousands of windings and arcs are tried where frequencies alone count, and the best of them followed as far as valleys
are wider than what the bases miss. Which of them is right shows in models of their own: there a wrong valley is left
with ten times the misfit, and followed further without one the right ones are led astray.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from operator import attrgetter
from typing import TypeVar

import numpy as np
from scipy.stats import qmc

from statorhom.diagnose.fits.explanations import COARSE, NARROWING, by_degrees, in_valleys, narrowed, refitted
from statorhom.diagnose.fits.few_vectors import in_few_vectors, in_few_vectors_near
from statorhom.diagnose.fits.hypothesis import Hypothesis
from statorhom.diagnose.fits.refit import Refit, refit_objective
from statorhom.diagnose.fits.valleys import FAR_BEHIND, apart, different, nearest_first, over_the_prior
from statorhom.diagnose.processes.side_by_side import side_by_side
from statorhom.diagnose.searches.refit_starts import Start
from statorhom.diagnose.searches.sharper import ITSELF, in_its_own_model
from statorhom.errors import StatorhomError

TRAINED = ((np.deg2rad(60.0), 1e-4), (np.deg2rad(140.0), 1e-4))  # widths and ratios that the bases know
WIDTH, RATIO, ANGLE = "arc_deg", "contact_ratio", "angle_rad"
PLACES = 24  # angles where a narrow valley begins
LAST = 3  # of what was judged in models of their own, that get another one

_T = TypeVar("_T")


@dataclass(frozen=True)
class Reach:
    """Where arcs are sought.

    Parameters
    ----------
    widths_deg, ratios : of the arcs that are tried.
    aside : prior standard deviations to either side of the start's winding; None where windings are tried all over
        the prior.
    discrepancy : of the valleys in which points are scored.
    samples : windings and arcs whose modes span the few vectors.
    trials : points.
    followed : how many of them are followed; and, where the bases were made for what is sought, fewer as the valleys
        narrow by degrees.
    models : how many of the optima are compared in models of their own; none where the bases were made for them.
    """

    widths_deg: tuple[float, float]
    ratios: tuple[float, float]
    aside: float | None
    discrepancy: float
    samples: int
    trials: int
    followed: tuple[int, ...]
    models: int

    def windings(self, parts: np.ndarray, around: np.ndarray) -> np.ndarray:
        """Coordinates of a winding for parts (0 … 1) of the reach."""
        return over_the_prior(parts) if self.aside is None else around + self.aside * (2 * parts - 1)

    def arcs(self, parts: np.ndarray) -> dict[str, float]:
        """Width (deg) and ratio for parts (0 … 1) of the reach."""
        ranges = ((WIDTH, self.widths_deg), (RATIO, self.ratios))
        return {
            name: float(low * (high / low) ** p) for p, (name, (low, high)) in zip(parts, ranges, strict=True)
        }


ANYWHERE = Reach(
    widths_deg=(35.0, 220.0),
    ratios=(2e-5, 3e-3),
    aside=None,
    discrepancy=COARSE,
    samples=48,
    trials=1500,
    followed=(24,),
    models=4,
)
NEARBY = Reach(
    widths_deg=(12.0, 90.0),
    ratios=(5e-5, 5e-3),
    aside=0.5,
    discrepancy=NARROWING[0],
    samples=24,
    trials=300,
    followed=(8, 6, 4),
    models=0,
)


def best_arc(
    start: Start, winding: Sequence[int], worth: float, reach: Reach, draw: int = 0
) -> np.ndarray | None:
    """Coordinates of the best arc; None where no winding will do.

    Parameters
    ----------
    start : an arc, in bases that know arcs such as are sought.
    winding : places of the constants that are sought with it.
    worth : objective that is reached without; few vectors may miss the arc's by some.
    reach : where it is sought.
    draw : of the points that are tried: another one may lead to a valley that the first one missed.
    """
    few = in_few_vectors(start.hypothesis, _points(start, winding, reach, reach.samples, 2 * draw + 1))
    rough = replace(few, discrepancy=reach.discrepancy, trained=False)
    nearest = nearest_first(rough, _points(start, winding, reach, reach.trials, 2 * draw))
    most, *fewer = reach.followed
    found = _optima(partial(in_valleys, few, discrepancy=NARROWING[0]), apart(nearest, most), few)
    for follow, count in zip((_narrower, _turned), fewer, strict=False):
        found = _optima(follow, found[:count], few)
    found = [r for r in found if r.objective < worth + FAR_BEHIND]
    if not found:
        return None
    return _best(start.hypothesis, varied(start.hypothesis, winding), found, reach.models)


def _points(start: Start, winding: Sequence[int], reach: Reach, count: int, seed: int) -> list[np.ndarray]:
    """Windings with arcs of all widths and ratios within a reach; wide valleys see no angle."""
    known = {p.name: p for p in start.hypothesis.candidates[-1].parameters}
    own, places = len(winding), list(winding)
    found = []
    for row in qmc.LatinHypercube(own + 2, seed=seed).random(count):
        z = start.z.copy()
        z[places] = reach.windings(row[:own], start.z[places])
        for name, value in reach.arcs(row[own:]).items():
            z[_place(start.hypothesis, name)] = known[name].internal(value)
        found.append(np.clip(z, *start.hypothesis.limits()))
    return found


def _place(hypothesis: Hypothesis, name: str) -> int:
    """Of a parameter of the arc among the coordinates."""
    names = [p.name for p in hypothesis.candidates[-1].parameters]
    return len(hypothesis) - len(names) + names.index(name)


def _optima(refit: Callable[[_T], Refit | None], starts: Sequence[_T], few: Hypothesis) -> list[Refit]:
    """Different ones, the best first."""
    found = side_by_side(refit, starts, few.shared)
    return _different([r for r in found if r is not None])


def _different(found: Sequence[Refit]) -> list[Refit]:
    """Those that are no neighbours of better ones, wherever their arcs are: each was begun at its best place."""
    return different(found, lambda r: np.delete(r.z, _place(r.hypothesis, ANGLE)))


def _narrower(found: Refit) -> Refit | None:
    """The optimum next to one in wider valleys: in these most that will not do in the narrowest ones stay behind."""
    return narrowed(found, NARROWING[1:])


def _turned(found: Refit) -> Refit | None:
    """In the narrowest valleys, and from the best place of its arc: wide ones see none."""
    narrow = in_valleys(found.hypothesis, found.z, 0.0)
    if narrow is None:
        return None
    own = replace(narrow.hypothesis, held=None)
    begun = nearest_first(own, [narrow.z, *_all_around(own, narrow.z)])
    return refitted(own, begun[0]) if begun else None


def _all_around(hypothesis: Hypothesis, z: np.ndarray) -> list[np.ndarray]:
    """The same arc at every angle."""
    place, angle = _place(hypothesis, ANGLE), {p.name: p for p in hypothesis.candidates[-1].parameters}[ANGLE]
    turns = 2 * np.pi * np.arange(PLACES) / PLACES
    return [np.r_[z[:place], angle.internal(float(turn)), z[place + 1 :]] for turn in turns]


def varied(hypothesis: Hypothesis, winding: Sequence[int]) -> list[int]:
    """Places of what is sought: a winding's constants, and the width and the ratio of the arc."""
    return [*winding, _place(hypothesis, WIDTH), _place(hypothesis, RATIO)]


@dataclass(frozen=True, eq=False)
class _Judged:
    """The optimum next to a point in a model of its own, which is not handed on: to make it again costs less.

    Parameters
    ----------
    objective, z : in all vectors.
    """

    objective: float
    z: np.ndarray


def _best(hypothesis: Hypothesis, places: Sequence[int], found: Sequence[Refit], models: int) -> np.ndarray:
    """Of the first optima the one that leaves least in a model of its own, where that led it.

    Each way into a model of its own may be led astray by lines of another order, and only the model of what it leads
    to shows that: the last ones get one of that place, too.
    """
    if not models:
        return found[0].z  # a model of its own is made by whoever asked
    judge = partial(_judged, hypothesis, places)
    judged = sorted(side_by_side(judge, [r.z for r in found[:models]]), key=attrgetter("objective"))
    again = side_by_side(judge, [j.z for j in judged[:LAST]])
    return min(again, key=attrgetter("objective")).z


def _judged(hypothesis: Hypothesis, places: Sequence[int], z: np.ndarray) -> _Judged:
    """The optimum next to a point where its materials and its arc are solved.

    Mesh factors are its own too: those of a typical winding lead some of the right windings to a fifth of their shear.
    """
    try:
        own = in_its_own_model(hypothesis, z, around=ITSELF)
        near = followed_near(own, places, z)
        if near is None:
            return _Judged(np.inf, z)
        return _Judged(refit_objective(own, near), near)
    except (StatorhomError, KeyError):
        return _Judged(np.inf, z)


def followed_near(own: Hypothesis, places: Sequence[int], z: np.ndarray) -> np.ndarray | None:
    """The best optimum next to a point, straight or as valleys narrow, in the vectors that points around it span.

    Its arc is turned to its best place.

    Parameters
    ----------
    own : an arc in a model of its own.
    places : of what will move (`varied`).
    z : the point.
    """
    few = in_few_vectors_near(own, z, places)
    found = [r for way in (refitted, by_degrees) if (r := way(few, z)) is not None]
    turned = [_turned(r) or r for r in found]
    return min(turned, key=lambda r: r.objective).z if turned else None
