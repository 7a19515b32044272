"""What costs little, sought where its step's materials are as usual, where nothing explains the misfit.

Without it the declared model may have fled: a soft end winding was a whole winding a tenth as stiff, with most modes
without a partner. Beside that nothing explains anything, and in its basis the right winding would fit no better. So
each step is solved anew with typical materials, and the effects on it are tried with materials all over the prior.

It may also have fled to where it explains everything (`statorhom.diagnose.searches.fled_materials`).
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

import numpy as np

from statorhom.diagnose.evidence.decision import OVER_NOTHING
from statorhom.diagnose.fits.explanations import ADEQUATE, Explanation, explained, nothing
from statorhom.diagnose.fits.hypothesis import Hypothesis
from statorhom.diagnose.fits.refit import Refit
from statorhom.diagnose.processes.side_by_side import side_by_side
from statorhom.diagnose.searches.best_refit import MOSTLY, optima_elsewhere
from statorhom.diagnose.searches.fled_materials import typical_where_fled
from statorhom.diagnose.searches.refit_starts import Start, cheap_starts, first_start, shared_by
from statorhom.diagnose.searches.sharper import sharpened
from statorhom.diagnose.stages.stage_model import StageModel
from statorhom.physics.candidate import Candidate

OWN_MODELS = 3  # of the best that are compared in models of their own
NEAR = 60.0  # of the objective: what does not come so near to the best gets none


def beside_typical_materials(
    base: Refit, found: Sequence[Explanation], candidates: Sequence[Candidate], counts: dict[str, int]
) -> list[Explanation]:
    """Explanations beside other materials, the best first; none where one of them is no better than what is known.

    Parameters
    ----------
    base : the declared model.
    found : explanations beside it, the best first.
    candidates : all effects.
    counts : effect → number of its candidates, over which its prior is spread.
    """
    none = nothing(base)
    best = found[0] if found else none
    enough = max(best.adequacy_but_one, none.adequacy_but_one) > ADEQUATE
    # what explains most of the misfit where the declared model stands says that it belongs there
    leads = bool(found) and best.refit.objective < MOSTLY * base.objective
    if leads or not isinstance(base.hypothesis, Hypothesis):
        return []
    # sheets are known too well to flee
    stages, least = base.hypothesis.study.stages, -np.inf
    if enough:
        stages, least = stages[1:], OVER_NOTHING
    begun = [start for stage in stages for start in _starts(base, stage, candidates, least)]
    again = side_by_side(_best_anywhere, begun, shared_by(begun))
    own = in_own_models([r for r in again if r is not None], counts)
    return own if own and own[0].log_evidence > best.log_evidence else []


def _starts(
    base: Refit[Hypothesis], stage: StageModel, candidates: Sequence[Candidate], least: float
) -> list[Start]:
    """A step's effects that cost little, in the model of its typical materials.

    Parameters
    ----------
    least : log evidence that typical materials have to gain, to first order, if they explain as much.
    """
    cheap = cheap_starts(base, [c for c in candidates if c.stage == stage.name])
    typical = typical_where_fled(base, stage, least) if cheap else None
    if typical is None:
        return []
    return [first_start(typical, start.hypothesis.candidates[-1]) for start in cheap]


def _best_anywhere(start: Start) -> Refit | None:
    """The best optimum that is found all over the prior of the step."""
    return min(optima_elsewhere(start), key=lambda r: r.objective, default=None)


def in_own_models(found: Sequence[Refit], counts: dict[str, int]) -> list[Explanation]:
    """The best of some optima in models of their own, and the others as they are; the best first.

    Parameters
    ----------
    found : the optima.
    counts : effect → number of its candidates, over which its prior is spread.
    """
    ordered = sorted(found, key=lambda r: r.objective)
    near = [r for r in ordered[:OWN_MODELS] if r.objective < ordered[0].objective + NEAR]
    shared = [one for r in near for one in (r.hypothesis, *r.hypothesis.shared)]
    own = side_by_side(partial(_sharper, counts), near, shared)
    rest = [explained(r, counts) for r in ordered[len(near) :]]
    return sorted((*own, *rest), key=lambda e: -e.log_evidence)


def _sharper(counts: dict[str, int], found: Refit) -> Explanation:
    return explained(sharpened(explained(found, counts)).refit, counts)
