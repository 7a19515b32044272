"""A contact that is lost over an arc, where nothing explains the misfit, or something does that an arc looks like.

The declared model, whose winding holds on everywhere, takes the lost contact for a winding that is ten or fifty times
too soft, and so softly held a winding has no use for a contact that is lost. So arcs are sought beside windings all
over the prior (`statorhom.diagnose.searches.arc_search`), and what is found gets models of its own. They are sought
behind what explains everything with a winding that has fled, too: beside a lost contact another name of a line does.

A narrow arc leaves the winding as it is. What it does to the few lines of a wound stator a lump does as well, or
whatever else parts them: behind such a lead arcs are sought beside the winding that came with it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import cache

import numpy as np

from statorhom.diagnose.evidence.decision import NEAR_RIVAL, OVER_NOTHING
from statorhom.diagnose.fits.explanations import (
    ADEQUATE,
    WELL,
    Explanation,
    explained,
    nothing,
    refitted,
)
from statorhom.diagnose.fits.hypothesis import Hypothesis
from statorhom.diagnose.fits.own_model import in_its_own_model
from statorhom.diagnose.fits.refit import Refit
from statorhom.diagnose.searches.arc_search import (
    ANYWHERE,
    NEARBY,
    RATIO,
    WIDTH,
    Reach,
    best_arc,
    followed_near,
    varied,
)
from statorhom.diagnose.searches.earlier_steps import left_before
from statorhom.diagnose.searches.fled_materials import typical_where_fled
from statorhom.diagnose.searches.refit_starts import Start, first_start
from statorhom.diagnose.searches.sharper import keeps_symmetry, sharpened
from statorhom.diagnose.searches.typical_materials import with_typical_materials
from statorhom.diagnose.stages.constants import new_constants
from statorhom.errors import StatorhomError
from statorhom.physics.candidate import Candidate

ROUNDS = 3  # models of its own for the best one
GROSS = 1  # row that may be off by an error of the measurement before its winding has fled for that
NARROW = 0.6, 1.6  # times the width of an arc's first start, that the bases know where narrow arcs are sought


def with_lost_contact(
    base: Refit, found: Sequence[Explanation], candidates: Sequence[Candidate], counts: dict[str, int]
) -> list[Explanation]:
    """Arcs of lost contact that explain more than anything that was found, or come near what they look like.

    They are sought where much is left to explain, where the winding has fled, and behind what sits on the circumference
    of a winding's step.

    Parameters
    ----------
    base : the declared model.
    found : explanations, the best first.
    candidates : all effects.
    counts : effect → number of its candidates, over which its prior is spread.
    """
    arcs = [c for c in candidates if {WIDTH, RATIO} <= {p.name for p in c.parameters}]
    declared = nothing(base)
    best = found[0] if found else declared
    if arcs and declared.adequacy > ADEQUATE:
        # its few lines may be what a winding too soft explains; that others have no partner speaks against it, and so
        # does a lead that an arc looks like
        seen = best.log_evidence > declared.log_evidence + OVER_NOTHING
        arcs = [c for c in arcs if seen and (_lacks_partners(best.refit, c) or _looks_like(best, c))]
    arcs = [c for c in arcs if _may_rival(base, best, c)]
    if not arcs:
        return []
    at_its_best = cache(lambda: _at_its_best(best))
    is_open = not (_is_settled(best, arcs) or _is_settled(at_its_best(), arcs))
    anywhere = [
        c for c in arcs if is_open or _lacks_partners(best.refit, c) or _has_fled(best, at_its_best, c)
    ]
    if anywhere:
        own = [r for c in anywhere if (r := _beside_any(base, c, best.refit.cost)) is not None]
        return [e for r in own if (e := explained(r, counts)).log_evidence > best.log_evidence]
    alike = [c for c in arcs if _looks_like(best, c)]
    own = [r for c in alike if (r := _beside_that_of(best.refit, base, c)) is not None]
    return [e for r in own if (e := explained(r, counts)).log_evidence > best.log_evidence - NEAR_RIVAL]


def _may_rival(base: Refit, best: Explanation, arc: Candidate) -> bool:
    """Whether the steps before the arc's leave so little that it may come near what leads."""
    constants = best.refit.z[: base.hypothesis.constants]
    return left_before(base, arc.stage, [constants]) < best.refit.cost + 2 * NEAR_RIVAL


def _looks_like(best: Explanation, arc: Candidate) -> bool:
    """Whether what leads sits somewhere on the circumference of the arc's step, as an arc does, and is none."""
    return any(c.stage == arc.stage and c.effect != arc.effect and c.located for c in best.candidates)


def _is_settled(best: Explanation, arcs: Sequence[Candidate]) -> bool:
    """Whether what leads leaves nothing to explain.

    An arc has valleys where frequencies alone are right: its losses, which follow the contact, tell these apart, and
    contacts that nobody has seen strain the priors.
    """
    if best.candidates and best.candidates[-1] in arcs:
        return best.adequacy_of_all > WELL
    return best.adequacy_but_one > WELL


def _at_its_best(best: Explanation) -> Explanation:
    """What leads in a model of its own, where that costs little beside arcs: what breaks the symmetry takes as long."""
    return sharpened(best) if best.candidates and keeps_symmetry(best.refit) else best


def _lacks_partners(best: Refit, arc: Candidate) -> bool:
    """Whether what leads has not got some line of the arc's step: what lets go of the core has modes of its own."""
    own = {t.name for s in best.hypothesis.study.stages if s.name == arc.stage for t in s.tests}
    return any(f.lost and f.test in own for f in best.hypothesis.features(best.z))


def _has_fled(best: Explanation, at_its_best: Callable[[], Explanation], arc: Candidate) -> bool:
    """Whether the winding that came with what leads explains by being unusual or sure of nothing.

    What the mesh is sure of is known in a model of its own: in that of the declared winding, a tenth as stiff, one that
    a soft end winding leaves as it is seems as unsure. Such a model takes seconds, and arcs take minutes.
    """
    return _flees(best.refit, arc) and _flees(at_its_best().refit, arc)


def _flees(of: Refit, arc: Candidate) -> bool:
    stages = [s for s in of.hypothesis.study.stages if s.name == arc.stage]
    return any(typical_where_fled(of, stage, OVER_NOTHING, GROSS) is not None for stage in stages)


def _beside_any(base: Refit, candidate: Candidate, worth: float) -> Refit | None:
    """The best optimum of an arc beside any winding, in a model of its own; None where no winding will do.

    Parameters
    ----------
    base, candidate : the declared model, and the arc.
    worth : objective that is reached without an arc, its doubt included.
    """
    typical = with_typical_materials(base, candidate.stage)
    return None if typical is None else _sought(first_start(typical, candidate), worth, ANYWHERE)


def _beside_that_of(leader: Refit, base: Refit, candidate: Candidate) -> Refit | None:
    """The same beside windings like that of what leads."""
    constants = leader.z[: leader.hypothesis.constants]
    start = first_start(replace(base, z=constants), candidate)
    try:
        own = in_its_own_model(start.hypothesis, start.z, quick=True, around=NARROW)
    except (StatorhomError, KeyError):
        return None
    return _sought(replace(start, hypothesis=own), leader.objective, NEARBY)


def _sought(start: Start, worth: float, reach: Reach) -> Refit | None:
    """The best optimum of an arc within reach, in a model of its own."""
    winding = new_constants(start.hypothesis.study.constants, start.hypothesis.candidates[-1].stage)
    try:
        z = best_arc(start, winding, worth, reach)
    except (StatorhomError, KeyError):
        return None
    return None if z is None else _in_own_models(start.hypothesis, varied(start.hypothesis, winding), z)


def _in_own_models(hypothesis: Hypothesis, places: Sequence[int], z: np.ndarray) -> Refit | None:
    """Refitted in a model of its own, and in further ones while that explains more and much is left to explain."""
    best = _followed(in_its_own_model(hypothesis, z), places, z)
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
