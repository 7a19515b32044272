"""Refits of wrong dimensions in the model of the machine that they lead to.

What a dimension does to the frequencies is a cubic about the declared machine, whose constants had made up for it. An
optimum far away is followed on its own machine, and so are the later steps' constants.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from statorhom.diagnose.fits.explanations import refitted
from statorhom.diagnose.fits.hypothesis import Hypothesis
from statorhom.diagnose.fits.own_model import in_its_own_model, is_far
from statorhom.diagnose.fits.refit import Refit
from statorhom.diagnose.fits.valleys import SETTLED
from statorhom.errors import StatorhomError

ROUNDS = 4
PART = 0.9  # of the declared model's objective: what leaves more explains next to nothing

Beside = Callable[[Refit], Sequence[Refit]]


def from_its_own_machine(found: Refit, known: float, beside: Beside) -> Refit:
    """An optimum with another dimension; the same where it lies near or explains nothing.

    Parameters
    ----------
    found : an optimum.
    known : the declared model's objective.
    beside : more optima of a hypothesis, beside other constants; none where nothing is left to explain.
    """
    hypothesis = found.hypothesis
    if not isinstance(hypothesis, Hypothesis) or found.objective > PART * known:
        return found
    if not is_far(hypothesis, found.z):
        return found
    there = on_its_machine(hypothesis, found.z, known, beside)
    return found if there is None else min(found, there, key=_objective)


def on_its_machine(hypothesis: Hypothesis, z: np.ndarray, known: float, beside: Beside) -> Refit | None:
    """The optimum that machines drawn anew lead to from somewhere, one after the other; None where there is none.

    Parameters
    ----------
    hypothesis, z : with another dimension.
    known, beside : as of `from_its_own_machine`.
    """
    best: Refit | None = None
    for _ in range(ROUNDS):
        near = _next_to(hypothesis, z)
        if near is None:
            break
        # what the cubic promised is no measure: it may have been wrong in favour of where it led
        again = min((near, *beside(near)), key=_objective)
        if again.objective > (known if best is None else best.objective - SETTLED):
            break
        best, hypothesis, z = again, again.hypothesis, again.z
    return best


def _next_to(hypothesis: Hypothesis, z: np.ndarray) -> Refit | None:
    """The optimum in the model of the machine there; None where no stator has its constants."""
    try:
        own = in_its_own_model(hypothesis, z)
    except StatorhomError:
        return None
    return refitted(own, z)


def _objective(found: Refit) -> float:
    return found.objective
