"""The declared model in a deeper valley, where an explanation's constants lead into one.

The constants of a winding have many valleys, and an effect may be what leads from one to another: a part of the winding
that all but takes part, in constants that explain everything else, is no missing physics.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from statorhom.diagnose.fits.absence import likeliest_without, shown_by_magnitudes
from statorhom.diagnose.fits.baseline import Baseline, baseline_at
from statorhom.diagnose.fits.explanations import ADEQUATE, Explanation, blank, nothing, refitted
from statorhom.diagnose.searches.sharper import sharpened

DEEPER = 20.0  # of the cost, that another valley must be deeper to be the declared model's
LEADING = 3  # explanations whose constants are tried
FAR = 150.0  # of the cost, by which an explanation that leaves nothing is beyond doubt in any valley


def declared_again(base: Baseline, found: Sequence[Explanation]) -> Baseline | None:
    """The declared model at the optimum next to an explanation's constants; None where it is none the better there.

    Parameters
    ----------
    base : the declared model.
    found : explanations, the best first.
    """
    again = [refitted(blank(e.refit.hypothesis, ()), z) for e in found[:LEADING] for z in _starts(e)]
    best = min((r for r in again if r is not None), key=lambda r: r.cost, default=None)
    if best is None or best.cost > base.refit.cost - DEEPER:
        return None
    if found[0].adequacy_but_one > ADEQUATE and best.cost > found[0].refit.cost + FAR:
        return None
    own = sharpened(nothing(best)).refit
    deeper = baseline_at(own.hypothesis.study, own.z, (base.free.z, *base.valleys))
    return deeper if deeper.refit.cost < base.refit.cost - DEEPER else None


def _starts(explanation: Explanation) -> list[np.ndarray]:
    """An explanation's constants, and what they would be without the effect where that may as well be absent."""
    r = explanation.refit
    here = r.z[: r.hypothesis.constants]
    everything = range(len(explanation.candidates))
    return [here] if all(shown_by_magnitudes(explanation)) else [here, likeliest_without(r, everything)]
