"""A contact that is lost over an arc, where nothing explains the misfit, or only an arc does and not well.

The declared model, whose winding holds on everywhere, takes the lost contact for a winding that is ten or fifty times
too soft, and so softly held a winding has no use for a contact that is lost. So arcs are sought beside windings all
over the prior (`statorhom.diagnose.searches.arc_search`), and what is found gets models of its own.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from statorhom.diagnose.fits.explanations import (
    ADEQUATE,
    WELL,
    Explanation,
    explained,
    nothing,
    refitted,
)
from statorhom.diagnose.fits.hypothesis import Hypothesis
from statorhom.diagnose.fits.refit import Refit, evaluated
from statorhom.diagnose.searches.arc_search import (
    RANGES,
    TRAINED,
    arc_beside_any_winding,
    followed_near,
    varied,
)
from statorhom.diagnose.searches.refit_starts import first_start
from statorhom.diagnose.searches.sharper import in_its_own_model
from statorhom.diagnose.searches.typical_materials import with_typical_materials
from statorhom.diagnose.stages.constants import new_constants
from statorhom.errors import StatorhomError
from statorhom.physics.candidate import Candidate

ROUNDS = 3  # models of its own for the best one


def with_lost_contact(
    base: Refit, found: Sequence[Explanation], candidates: Sequence[Candidate], counts: dict[str, int]
) -> list[Explanation]:
    """Arcs of lost contact that explain more than anything that was found, where that leaves much to explain.

    Parameters
    ----------
    base : the declared model.
    found : explanations, the best first.
    candidates : all effects.
    counts : effect → number of its candidates, over which its prior is spread.
    """
    arcs = [c for c in candidates if set(RANGES) < {p.name for p in c.parameters}]
    if not arcs:
        return []
    best = found[0] if found else nothing(base)
    if _is_settled(best, arcs) or nothing(base).adequacy > ADEQUATE:
        return []
    own = (explained(r, counts) for c in arcs if (r := _sought(base, c, best.refit.objective)) is not None)
    return [e for e in own if e.log_evidence > best.log_evidence]


def _is_settled(best: Explanation, arcs: Sequence[Candidate]) -> bool:
    """Whether what leads leaves nothing to explain.

    An arc has valleys where frequencies alone are right: its losses, which follow the contact, tell these apart, and
    contacts that nobody has seen strain the priors.
    """
    if best.candidates and best.candidates[-1] in arcs:
        return best.adequacy_of_all > WELL
    return best.adequacy_but_one > WELL


def _sought(base: Refit, candidate: Candidate, worth: float) -> Refit | None:
    """The best optimum of an arc beside any winding, in a model of its own; None where no winding will do.

    Parameters
    ----------
    base, candidate : the declared model, and the arc.
    worth : objective that is reached without an arc.
    """
    typical = with_typical_materials(base, candidate.stage, quick=True, arcs=TRAINED)
    if typical is None:
        return None
    start = first_start(typical, candidate)
    winding = new_constants(base.hypothesis.study.constants, candidate.stage)
    z = arc_beside_any_winding(start, winding, worth)
    try:
        there = None if z is None else evaluated(start.hypothesis, z)
    except (StatorhomError, KeyError):
        return None
    return None if there is None else _in_own_models(there, varied(there.hypothesis, winding))


def _in_own_models(found: Refit, places: Sequence[int]) -> Refit | None:
    """Refitted in a model of its own, and in further ones while that explains more and much is left to explain."""
    best = _followed(in_its_own_model(found.hypothesis, found.z), places, found.z)
    for _ in range(ROUNDS - 1):
        if best is None or explained(best, {}).adequacy > ADEQUATE:
            break
        again = _followed(in_its_own_model(best.hypothesis, best.z), places, best.z)
        if again is None or again.objective >= best.objective:
            break
        best = again
    return best


def _followed(own: Hypothesis, places: Sequence[int], z: np.ndarray) -> Refit | None:
    """The optimum next to a point: followed in few vectors, and the last steps in all."""
    near = followed_near(own, places, z)
    return None if near is None else refitted(own, near)
