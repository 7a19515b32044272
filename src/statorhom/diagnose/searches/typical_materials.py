"""The declared model where a step's materials are as usual: where data led it may be far from where it belongs."""

from __future__ import annotations

from statorhom.diagnose.fits.explanations import blank
from statorhom.diagnose.fits.hypothesis import Hypothesis
from statorhom.diagnose.fits.own_model import in_its_own_model
from statorhom.diagnose.fits.refit import Refit, evaluated
from statorhom.diagnose.stages.constants import new_constants
from statorhom.errors import StatorhomError


def with_typical_materials(base: Refit[Hypothesis], stage: str) -> Refit[Hypothesis] | None:
    """In the model of the prior's median of a step; None where no stator has it, or the step nothing of its own.

    Parameters
    ----------
    base : the declared model.
    stage : the step.
    """
    hypothesis, z = base.hypothesis, base.z.copy()
    places = new_constants(hypothesis.study.constants, stage)
    if not places:
        return None
    z[places] = 0.0
    try:
        return evaluated(in_its_own_model(blank(hypothesis, hypothesis.candidates), z), z)
    except (StatorhomError, KeyError):
        return None
