"""Starts of an effect's refit all over the prior of its step: far from any optimum the declared model is no guide."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from statorhom.diagnose.fits.hypothesis import Hypothesis
from statorhom.diagnose.fits.refit import Refit
from statorhom.diagnose.fits.valleys import trials_around, wide_optima
from statorhom.diagnose.stages.constants import new_constants
from statorhom.errors import IdentificationError

REFITTED = 6  # points that are followed in wide valleys
SUPPORTS = 8  # that are tried, each with many materials
ALONE = 24  # that are tried beside what free tests have told of the materials


def searched_starts(
    hypothesis: Hypothesis, z: np.ndarray, seed: int = 0, most: int = REFITTED
) -> list[Refit[Hypothesis]]:
    """Different optima in wide valleys, the best first; none where the effect's step has no constants to be found.

    Parameters
    ----------
    hypothesis : with the effect as its last one.
    z : all coordinates; the constants of other steps and what the effect is added to stay there until an optimum is
        sought.
    seed : of the points.
    most : of them that are followed.
    """
    candidate = hypothesis.candidates[-1]
    constants = hypothesis.study.constants
    places = new_constants(constants, candidate.stage)
    if not places:
        return []
    low, high = hypothesis.limits()
    # what the effect is added to is known, and where it breaks the symmetry another place of it costs a solution
    own = range(len(z) - len(candidate.parameters), len(z))
    points = trials_around(z, [*places, *own], seed)
    if any(action.supports for action in hypothesis.actions(z)):
        points = [*_with_few_supports(points, len(constants)), *trials_around(z, own, seed)[:ALONE]]
    try:
        quick = replace(hypothesis, trained=False)
        return wide_optima(quick, [np.clip(point, low, high) for point in points], most)
    except IdentificationError:
        return []


def of_later_steps(found: Refit[Hypothesis], seed: int = 0) -> list[Refit[Hypothesis]]:
    """The effect as found and other optima of the constants of later steps, in wide valleys, the best first.

    Those were sought without the effect: under a wrong mass, or beside another's stiffness, they lie in another valley.

    Parameters
    ----------
    found : with the effect as its last one.
    seed : of the points.
    """
    hypothesis, z = replace(found.hypothesis, held=None, trained=False), found.z
    low, high = hypothesis.limits()
    optima: list[Refit[Hypothesis]] = []
    for stage in _after(hypothesis):
        places = new_constants(hypothesis.study.constants, stage)
        if not places:
            continue
        try:
            points = [np.clip(point, low, high) for point in trials_around(z, places, seed)]
            optima = wide_optima(hypothesis, points, REFITTED)
        except IdentificationError:
            return []
        z = optima[0].z
    return optima


def _after(hypothesis: Hypothesis) -> list[str]:
    """The tested steps after the effect's own."""
    order = [stage.name for stage in hypothesis.study.files.study.stages]
    own = order.index(hypothesis.candidates[-1].stage)
    return [s.name for s in hypothesis.study.stages if order.index(s.name) > own]


def _with_few_supports(points: Sequence[np.ndarray], constants: int) -> list[np.ndarray]:
    """The same constants with few supports, neighbours with the same: a support costs more than a material."""
    run = -(-len(points) // SUPPORTS)
    return [np.r_[z[:constants], points[i // run * run][constants:]] for i, z in enumerate(points)]
