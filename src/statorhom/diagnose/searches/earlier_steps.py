"""What the steps before an effect's own leave whatever it does: no effect of the winding mends a bare stack."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from statorhom.diagnose.fits.explanations import blank, refitted
from statorhom.diagnose.fits.hypothesis import Hypothesis
from statorhom.diagnose.fits.refit import Refit


def left_before(base: Refit[Hypothesis], step: str, elsewhere: Iterable[np.ndarray]) -> float:
    """Objective of the declared model in the steps before one, which no effect of that step is below; 0 without any.

    Parameters
    ----------
    base : the declared model.
    step : the effect's.
    elsewhere : other constants to begin from.
    """
    study = base.hypothesis.study
    order = [stage.name for stage in study.files.study.stages]
    before = tuple(s for s in study.stages if order.index(s.name) < order.index(step))
    if not before:
        return 0.0
    alone = blank(base.hypothesis, base.hypothesis.candidates).with_stages(before)
    found = (refitted(alone, z) for z in (base.z, *elsewhere))
    return min((r.objective for r in found if r is not None), default=0.0)
