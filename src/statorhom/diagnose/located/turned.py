"""Which of the angles that the strongest doublets do not tell apart: the weaker ones know, and no refit gets there.

A doublet of order r is parted alike by a cause at θ and by one π/r further on. Where one order's splits are far larger
than all others', a refit from either angle ends there, and what it leaves of the other orders has the wrong sign.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from math import pi

import numpy as np

from statorhom.diagnose.fits.explanations import refitted
from statorhom.diagnose.fits.refit import Refit
from statorhom.diagnose.fits.valleys import nearest_first
from statorhom.diagnose.located.opposite import TOLD
from statorhom.physics.parameter import EffectParameter


def at_fitting_angle(best: Refit, worth: float = np.inf) -> Refit:
    """An optimum, or the one with an effect at another angle that parts a measured doublet alike and leaves less.

    Parameters
    ----------
    best : the optimum.
    worth : objective above which another one matters to nobody.
    """
    turns = _turns(best)
    if not turns:
        return best
    for place, angle in _angles(best):
        here = replace(best.hypothesis, held=None)
        nearest = nearest_first(here, [best.z, *(_turned(best.z, place, angle, turn) for turn in turns)])
        if not nearest or nearest[0] is best.z:
            continue
        there = refitted(here, nearest[0], min(best.objective, worth))
        if there is not None and there.objective < best.objective:
            best = there
    return best


def _turns(best: Refit) -> list[float]:
    """Parts of half a turn (rad) by which an order that is clearly split can be turned unnoticed.

    Splits of which the angle was measured have two features each.
    """
    splits = [f for f in best.hypothesis.features(best.z) if f.kind == "split" and f.key]
    rows = Counter((f.test, f.key) for f in splits)
    orders = {f.key[0] for f in splits if f.key and rows[f.test, f.key] > 1 and abs(f.measured) > TOLD * f.sd}
    return sorted({pi * k / order for order in orders for k in range(1, order)})


def _angles(best: Refit) -> list[tuple[int, EffectParameter]]:
    """Where the effects' angles stand in the vector, and their parameters."""
    h = best.hypothesis
    found = ((h.constants + k, h.candidates[i].parameters[j]) for k, (i, j) in enumerate(h.parameters))
    return [(place, parameter) for place, parameter in found if parameter.scale == "angle"]


def _turned(z: np.ndarray, place: int, parameter: EffectParameter, turn: float) -> np.ndarray:
    """Coordinates with one angle turned."""
    turned = z.copy()
    turned[place] = parameter.internal(parameter.value(float(z[place])) + turn)
    return turned
