"""Arcs of lost contact, sought beside windings all over the prior, or like one that is known.

A contact that is lost over a wide arc lets much of the winding go, and few frequencies tell how stiff the rest is:
there are many valleys nearly as deep. In bases that know such arcs beside windings all over the prior, and in the few
vectors that matter there, thousands of windings and arcs are tried where frequencies alone count, and the best of them
followed as far as valleys are wider than what the bases miss. Then bases are made that know these, and what they lead
to is followed and compared there, in one model: in bases that know only one of them, right windings are led astray.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import TypeVar

import numpy as np
from scipy.stats import qmc

from statorhom.diagnose.fits.explanations import (
    COARSE,
    NARROWING,
    WELL,
    by_degrees,
    explained,
    in_valleys,
    narrowed,
    refitted,
)
from statorhom.diagnose.fits.few_vectors import in_few_vectors, in_few_vectors_near, with_neighbours
from statorhom.diagnose.fits.hypothesis import Hypothesis
from statorhom.diagnose.fits.own_model import ITSELF, in_its_own_model
from statorhom.diagnose.fits.refit import Refit
from statorhom.diagnose.fits.valleys import FAR_BEHIND, apart, different, nearest_first, over_the_prior
from statorhom.diagnose.processes.side_by_side import side_by_side
from statorhom.diagnose.searches.refit_starts import Start

WIDTH, RATIO, ANGLE = "arc_deg", "contact_ratio", "angle_rad"
PLACES = 24  # angles where a narrow valley begins
TRIALS, SAMPLES, KNOWN = 0, 1, 7  # seeds: of what is tried, of what spans few vectors, and of what bases know

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
    known : windings and arcs that the bases know as the mesh has them; none where they were made for what is sought.
    samples, vectors : windings and arcs whose modes span the few vectors of one family.
    trials : points.
    followed : how many of them are followed; and, where the bases were made for what is sought, fewer as the valleys
        narrow by degrees.
    again : how many of the optima are followed once more in bases that know them, again and again.
    """

    widths_deg: tuple[float, float]
    ratios: tuple[float, float]
    aside: float | None
    discrepancy: float
    known: int
    samples: int
    vectors: int
    trials: int
    followed: tuple[int, ...]
    again: tuple[int, ...]

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
    known=8,
    samples=96,
    vectors=200,
    trials=1500,
    followed=(24,),
    again=(8, 4),
)
NEARBY = Reach(
    widths_deg=(12.0, 90.0),
    ratios=(5e-5, 5e-3),
    aside=0.5,
    discrepancy=NARROWING[0],
    known=0,
    samples=24,
    vectors=80,
    trials=300,
    followed=(8, 6, 4),
    again=(),
)


def best_arc(start: Start, winding: Sequence[int], worth: float, reach: Reach) -> np.ndarray | None:
    """Coordinates of the best arc; None where no winding will do.

    Parameters
    ----------
    start : an arc; where no bases are made to know others, in such as were made for what is sought.
    winding : places of the constants that are sought with it.
    worth : objective that is reached without; few vectors may miss the arc's by some.
    reach : where it is sought.
    """
    # of what is found points alone are kept: each one's bases take gigabytes
    points = [r.z for r in _wide_optima(start, winding, reach) if r.objective < worth + FAR_BEHIND]
    for count in reach.again if points else ():
        points, is_right = _followed_again(start, winding, points[:count], reach.vectors)
        if is_right:
            break
    return points[0] if points else None


def _followed_again(
    start: Start, winding: Sequence[int], points: Sequence[np.ndarray], vectors: int
) -> tuple[list[np.ndarray], bool]:
    """What some points, the best first, lead to in bases that know them all; the best first.

    And whether that leaves nothing to explain.
    """
    best, *others = points
    # mesh factors of a typical winding lead some of the right ones to a fifth of their shear
    own = in_its_own_model(start.hypothesis, best, around=ITSELF, elsewhere=others)
    few = in_few_vectors(own, with_neighbours(own, points, varied(own, winding)), vectors)
    found = _optima(partial(_followed, few), points, few)
    return [r.z for r in found] or list(points), bool(found) and _leaves_nothing(found[0])


def _leaves_nothing(found: Refit) -> bool:
    return explained(found, {}).adequacy_of_all > WELL


def _wide_optima(start: Start, winding: Sequence[int], reach: Reach) -> list[Refit]:
    """Of all that is tried in one model, the best first."""
    hypothesis, known = start.hypothesis, _points(start, winding, reach, reach.known, KNOWN)
    if known:
        hypothesis = in_its_own_model(hypothesis, start.z, quick=True, around=ITSELF, elsewhere=known)
    few = in_few_vectors(hypothesis, _points(start, winding, reach, reach.samples, SAMPLES), reach.vectors)
    rough = replace(few, discrepancy=reach.discrepancy, trained=False)
    nearest = nearest_first(rough, _points(start, winding, reach, reach.trials, TRIALS))
    most, *fewer = reach.followed
    found = _optima(partial(in_valleys, few, discrepancy=NARROWING[0]), apart(nearest, most), few)
    for follow, count in zip((_narrower, _turned), fewer, strict=False):
        found = _optima(follow, found[:count], few)
    return found


def _followed(few: Hypothesis, z: np.ndarray) -> Refit | None:
    """The optimum next to a point in bases that know it: as valleys narrow, its arc turned to its best place."""
    wide = in_valleys(few, z, NARROWING[0])
    return None if wide is None else _turned(_narrower(wide))


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


def _narrower(found: Refit) -> Refit:
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
