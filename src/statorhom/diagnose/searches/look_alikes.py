"""What a lead is taken for, sought as thoroughly as where nothing explains the misfit, before the lead gets a name.

A winding has many valleys, and what costs little is sought in few of them as soon as something leaves no more than
noise. Of two effects that look alike the wrong one may be found first, and lead only because the other one was not.
The library says what looks alike. Where the declared model may do as well, so that little is known of the winding, they
are sought beside the one that came with the lead: whatever looks alike has it too.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from statorhom.diagnose.evidence.decision import NEAR_RIVAL, least_over_nothing
from statorhom.diagnose.fits.explanations import ADEQUATE, WELL, Explanation, nothing
from statorhom.diagnose.fits.hypothesis import Hypothesis
from statorhom.diagnose.fits.refit import Refit
from statorhom.diagnose.processes.side_by_side import side_by_side
from statorhom.diagnose.searches.beside_typical import in_own_models
from statorhom.diagnose.searches.refit_starts import best_of_sizes, cheap_starts, shared_by
from statorhom.diagnose.searches.thorough import best_of_many
from statorhom.diagnose.stages.study_model import StudyModel
from statorhom.physics.candidate import Candidate
from statorhom.physics.library import look_alike

NEAR = 120.0  # of the objective: how far behind the lead an optimum may be in the common model to get one of its own


def look_alikes(
    base: Refit, found: Sequence[Explanation], candidates: Sequence[Candidate], counts: dict[str, int]
) -> list[Explanation]:
    """Explanations by what the lead is taken for, where they are better than the lead or come near it.

    Parameters
    ----------
    base : the declared model.
    found : explanations beside it, the best first.
    candidates : all effects.
    counts : effect → number of its candidates, over which its prior is spread.
    """
    if not found or not isinstance(base.hypothesis, Hypothesis):
        return []
    best = found[0]
    # where more is left than noise it has been sought thoroughly already, and what leads by too little gets no name
    none = nothing(base)
    ahead = best.log_evidence - none.log_evidence > least_over_nothing(none.adequacy)
    if best.adequacy_but_one <= WELL or not ahead:
        return []
    alike = _taken_for(best, candidates, base.hypothesis.study)
    unknown = none.adequacy > ADEQUATE
    beside = replace(base, z=best.refit.z[: base.hypothesis.constants]) if unknown else base
    begun = cheap_starts(beside, alike)
    again = side_by_side(best_of_sizes if unknown else best_of_many, begun, shared_by(begun))
    near = [r for r in again if r is not None and r.objective < best.refit.objective + NEAR]
    return [e for e in in_own_models(near, counts) if e.log_evidence > best.log_evidence - NEAR_RIVAL]


def _taken_for(best: Explanation, candidates: Sequence[Candidate], study: StudyModel) -> list[Candidate]:
    """What looks like the lead on its own step; the first one's core has no other valleys."""
    later = {stage.name for stage in study.stages[1:]}
    leads = [c for c in best.candidates if c.stage in later]
    return [
        c
        for c in candidates
        if any(c.stage == lead.stage and look_alike(c, lead, study.files) for lead in leads)
    ]
