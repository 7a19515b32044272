"""What varies from end to end, where modes lean to one end and what leads does not say why.

A stiffness that rises along the axis mixes axial parities, and without it a step's stiffness along the axis has no
place where modes fit: it has fled to where few of them contradict, and in the bases of that place a strong gradient
explains nothing. So such effects are tried where this constant, the one of which least is known, is as usual, in bases
made there; the others, which modes without nodes along the axis tell, stay.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.stats import chi2

from statorhom.diagnose.fits.explanations import Explanation, nothing, refitted
from statorhom.diagnose.fits.hypothesis import Hypothesis
from statorhom.diagnose.fits.own_model import in_its_own_model
from statorhom.diagnose.fits.refit import Refit
from statorhom.diagnose.located.scan import starts as scan_starts
from statorhom.diagnose.processes.side_by_side import side_by_side
from statorhom.diagnose.searches.beside_typical import in_own_models
from statorhom.diagnose.searches.best_refit import is_a_field
from statorhom.diagnose.searches.refit_starts import Start, shared_by, start_of
from statorhom.diagnose.stages.constants import new_constants
from statorhom.errors import StatorhomError
from statorhom.physics.candidate import Candidate

BY_CHANCE = 0.01  # of the leans that an explanation leaves
PLACES = -1.0, 0.0, 1.0  # where the constant is tried, in prior standard deviations
FOLLOWED = 2  # optima of all places that get models of their own


def leaning_fields(
    base: Refit, found: Sequence[Explanation], candidates: Sequence[Candidate], counts: dict[str, int]
) -> list[Explanation]:
    """Explanations by what varies from end to end, where that is better than what is known.

    Parameters
    ----------
    base : the declared model.
    found : explanations beside it, the best first.
    candidates : all effects.
    counts : effect → number of its candidates, over which its prior is spread.
    """
    if not isinstance(base.hypothesis, Hypothesis):
        return []
    best = found[0] if found else nothing(base)
    # what is left of all rows together may be chance: where the constant has fled to, leans alone contradict
    tests = _leaning(best.refit)
    own = {stage.name for stage in base.hypothesis.study.stages if tests & {t.name for t in stage.tests}}
    begun = [s for c in candidates if c.stage in own and not c.located for s in _starts(base, c)]
    if not begun:
        return []
    again = side_by_side(_in_bases_of_its_own, begun, shared_by(begun))
    nearest = sorted((r for r in again if r is not None), key=lambda r: r.objective)[:FOLLOWED]
    return [e for e in in_own_models(nearest, counts) if e.log_evidence > best.log_evidence]


def _leaning(left: Refit) -> set[str]:
    """Tests of which an explanation leaves more lean than chance does."""
    squares: dict[str, list[float]] = {}
    for f in left.hypothesis.features(left.z):
        if f.kind == "lean" and not f.lost:
            squares.setdefault(f.test, []).append(f.residual**2)
    return {test for test, own in squares.items() if chi2.sf(sum(own), len(own)) < BY_CHANCE}


def _starts(base: Refit[Hypothesis], candidate: Candidate) -> list[Start]:
    """A field's, of every size, with the constant of its step of which least is known at some places."""
    constants = base.hypothesis.study.constants
    own = [i for i in new_constants(constants, candidate.stage) if constants.items[i].log]
    if not own or not candidate.parameters:
        return []
    widest = max(own, key=lambda i: constants.items[i].sd)
    begun = [start_of(base, candidate, one) for one in scan_starts(base.hypothesis.study, candidate)]
    return [
        Start(start.hypothesis, np.r_[start.z[:widest], place, start.z[widest + 1 :]])
        for start in begun
        if is_a_field(start.hypothesis, start.z)
        for place in PLACES
    ]


def _in_bases_of_its_own(start: Start) -> Refit | None:
    """The nearest optimum in bases made where it begins; None where no stator has these constants."""
    try:
        own = in_its_own_model(start.hypothesis, start.z, quick=True)
    except StatorhomError:
        return None
    return refitted(own, start.z)
