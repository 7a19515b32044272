"""Arcs of lost contact, sought beside windings all over the prior.

A contact that is lost over a wide arc lets much of the winding go, and few frequencies tell how stiff the rest is:
there are many valleys nearly as deep. In bases that know two such arcs, and in the few vectors that matter there,
thousands of windings and arcs are tried where frequencies alone count, and the best of them followed. Which of the
last ones is right shows in models of their own: there a wrong valley is left with ten times the misfit.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
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
RANGES = {"arc_deg": (35.0, 220.0), "contact_ratio": (2e-5, 3e-3)}  # that are tried
ANGLE = "angle_rad"
SAMPLES = 48  # windings and arcs whose modes span the few vectors
TRIALS = 1500  # points
FOLLOWED = 24, 12, 6  # that are followed, fewer as the valleys narrow by degrees
MODELS = 2  # that are compared in models of their own
PLACES = 24  # angles where a narrow valley begins
SEED = 0

_T = TypeVar("_T")


def arc_beside_any_winding(start: Start, winding: Sequence[int], worth: float) -> np.ndarray | None:
    """Coordinates of the best arc; None where no winding will do.

    Parameters
    ----------
    start : an arc, in bases that know arcs like `TRAINED`.
    winding : places of the constants that are sought with it.
    worth : objective that is reached without; few vectors may miss the arc's by some.
    """
    few = in_few_vectors(start.hypothesis, _points(start, winding, SAMPLES, SEED + 1))
    rough = replace(few, discrepancy=COARSE, trained=False)
    nearest = apart(nearest_first(rough, _points(start, winding, TRIALS, SEED)), FOLLOWED[0])
    found = _optima(partial(in_valleys, few, discrepancy=NARROWING[0]), nearest, few)
    found = _optima(_narrower, found[: FOLLOWED[1]], few)
    found = _optima(_turned, found[: FOLLOWED[2]], few)
    found = [r for r in found if r.objective < worth + FAR_BEHIND]
    return _best(start.hypothesis, winding, found) if found else None


def _points(start: Start, winding: Sequence[int], count: int, seed: int) -> list[np.ndarray]:
    """Windings all over the prior with arcs of all widths and ratios; wide valleys see no angle."""
    known = {p.name: p for p in start.hypothesis.candidates[-1].parameters}
    cube = qmc.LatinHypercube(len(winding) + len(RANGES), seed=seed).random(count)
    found = []
    for row in cube:
        z = start.z.copy()
        z[list(winding)] = over_the_prior(row[: len(winding)])
        for part, (name, (low, high)) in zip(row[len(winding) :], RANGES.items(), strict=True):
            z[_place(start.hypothesis, name)] = known[name].internal(float(low * (high / low) ** part))
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
    return [*winding, *(_place(hypothesis, name) for name in RANGES)]


def _best(start: Hypothesis, winding: Sequence[int], found: Sequence[Refit]) -> np.ndarray:
    """Of the last ones that are near each other, the one that leaves least in a model of its own, where that led it."""
    near = [r for r in found if r.objective < found[0].objective + FAR_BEHIND][:MODELS]
    judged = side_by_side(partial(_judged, start, varied(start, winding)), [r.z for r in near])
    return min(judged, key=lambda j: j[0])[1]


def _judged(start: Hypothesis, places: Sequence[int], z: np.ndarray) -> tuple[float, np.ndarray]:
    """Objective and coordinates of the optimum next to some, where its materials and its arc are solved.

    The few vectors of the search are off by percents: from there either way into a model of its own may be led astray
    by lines of another order, and only the model of what it leads to shows it. That one is not handed on: it is larger
    than what it takes to make it again once.
    """
    near = _in_model_of(start, places, z)
    if near is None:
        return np.inf, z
    again = _in_model_of(start, places, near[1])
    return near if again is None or again[0] > near[0] else again


def _in_model_of(
    hypothesis: Hypothesis, places: Sequence[int], z: np.ndarray
) -> tuple[float, np.ndarray] | None:
    """Objective and coordinates of the optimum near a point in its model; None where no body has its constants."""
    try:
        own = in_its_own_model(hypothesis, z, quick=True, around=ITSELF)
        there = followed_near(own, places, z)
        return None if there is None else (refit_objective(own, there), there)
    except (StatorhomError, KeyError):
        return None


def followed_near(own: Hypothesis, places: Sequence[int], z: np.ndarray) -> np.ndarray | None:
    """The best optimum next to a point, straight or as valleys narrow, in the vectors that points around it span.

    Parameters
    ----------
    own : an arc in a model of its own.
    places : of what will move (`varied`).
    z : the point.
    """
    few = in_few_vectors_near(own, z, places)
    found = [r for way in (refitted, by_degrees) if (r := way(few, z)) is not None]
    return min(found, key=lambda r: r.objective).z if found else None
