"""What varies all over a region, sought beside the constants of the declared model's other valleys too.

A strong one bends so many modes that the declared model without it may fit better in a wrong valley than in its own:
beside those constants another magnitude explains something, and only the size of what is left tells.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

import numpy as np

from statorhom.diagnose.fits.baseline import Baseline
from statorhom.diagnose.fits.explanations import (
    ADEQUATE,
    Explanation,
    blank,
    explained,
    through_wide_valleys,
    widened,
)
from statorhom.diagnose.fits.hypothesis import Hypothesis
from statorhom.diagnose.fits.own_model import in_its_own_model
from statorhom.diagnose.fits.refit import Refit
from statorhom.diagnose.located.scan import starts
from statorhom.diagnose.processes.side_by_side import side_by_side
from statorhom.diagnose.searches.best_refit import is_a_field
from statorhom.diagnose.searches.refit_starts import is_poor
from statorhom.diagnose.searches.sharper import sharpened
from statorhom.errors import StatorhomError

VALLEYS = 2  # that are followed, the best first
GAIN = 100.0  # of the objective, by which models of its own may better what its common one leaves


def in_other_valleys(
    base: Baseline, found: Sequence[Explanation], counts: dict[str, int]
) -> list[Explanation]:
    """The explanations, the best first; the best one that is all over its region in the best of the declared valleys.

    What is left of it in a wrong valley says little: others may lead there, as long as none explains enough.

    Parameters
    ----------
    base : the declared model, with its other valleys.
    found : explanations beside it, the best first.
    counts : effect → number of its candidates, over which its prior is spread.
    """
    field = next((e for e in found if is_a_field(e.refit.hypothesis, e.refit.z)), None)
    if field is None or not is_poor(base.free):
        return list(found)
    # a row that may be gross is no reason to stop: in the right valley it may be none
    if field is not found[0] and (found[0].adequacy > ADEQUATE or _costs_much(base)):
        return list(found)
    hypothesis, leading = field.refit.hypothesis, found[0].refit.objective
    begun = blank(hypothesis, hypothesis.candidates)
    follow = partial(_in_valley, begun, least=leading)
    again = side_by_side(follow, base.valleys[:VALLEYS], [begun, *begun.shared])
    best = min((r for r in again if r is not None), key=lambda r: r.objective, default=None)
    if best is None or best.objective > leading + GAIN:
        return list(found)
    own = sharpened(explained(best, counts)).refit
    if own.cost >= field.refit.cost:
        return list(found)
    others = [e for e in found if e is not field]
    return sorted((explained(own, counts), *others), key=lambda e: -e.log_evidence)


def _costs_much(base: Baseline) -> bool:
    """Whether models in each of the other valleys take minutes: those of several steps do."""
    return len(base.free.hypothesis.study.stages) > 1


def _in_valley(hypothesis: Hypothesis, constants: np.ndarray, *, least: float) -> Refit | None:
    """The optimum next to other constants, from the best magnitude in wide valleys, in a model of its own.

    What leaves more in wide valleys than another effect does in narrow ones is given up: narrow ones leave more.
    """
    points = [np.r_[constants, start] for start in starts(hypothesis.study, hypothesis.candidates[-1])]
    try:
        own = in_its_own_model(hypothesis, points[0])
    except (StatorhomError, KeyError):
        return None
    wide = [r for z in points if (r := widened(own, z)) is not None]
    rough = min(wide, key=lambda r: r.objective, default=None)
    if rough is None or rough.objective > least:
        return None
    return through_wide_valleys(own, rough.z, rough)
