"""Refits of wrong dimensions in the model of the machine that they lead to.

What a dimension does to the frequencies is a cubic about the declared machine, whose constants had made up for it. An
optimum far away is followed on its own machine, and so are the later steps' constants.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from statorhom.diagnose.fits.explanations import refitted
from statorhom.diagnose.fits.hypothesis import Hypothesis
from statorhom.diagnose.fits.own_model import in_its_own_model, is_far
from statorhom.diagnose.fits.refit import Refit
from statorhom.diagnose.fits.valleys import SETTLED
from statorhom.errors import StatorhomError

ROUNDS = 4
PART = 0.9  # of the declared model's objective: what leaves more explains next to nothing


def from_its_own_machine(found: Refit, known: float, beside: Callable[[Refit], Sequence[Refit]]) -> Refit:
    """An optimum with another dimension; the same where it lies near or explains nothing.

    Parameters
    ----------
    found : an optimum.
    known : the declared model's objective.
    beside : more optima of a hypothesis, beside other constants; none where nothing is left to explain.
    """
    if not _is_worth_it(found, known):
        return found
    for _ in range(ROUNDS):
        near = _there(found)
        if near is None:
            break
        again = min((near, *beside(near)), key=lambda r: r.objective)
        if again.objective > found.objective - SETTLED:
            break
        found = again
    return found


def _there(found: Refit) -> Refit | None:
    """The optimum next to it in the model of its own machine; None where no stator has its constants."""
    try:
        own = in_its_own_model(found.hypothesis, found.z)
    except StatorhomError:
        return None
    return refitted(own, found.z)


def _is_worth_it(found: Refit, known: float) -> bool:
    """Whether an optimum far from the machine that it is seen from explains something."""
    hypothesis = found.hypothesis
    if not isinstance(hypothesis, Hypothesis) or found.objective > PART * known:
        return False
    return is_far(hypothesis, found.z)
