"""A hypothesis whose arcs of lost contact have modes in few vectors: for searches that ask thousands of times."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from scipy.stats import qmc

from statorhom.diagnose.fits.hypothesis import Hypothesis
from statorhom.diagnose.stages.stage_model import StageModel
from statorhom.errors import StatorhomError
from statorhom.model.affine import Materials
from statorhom.physics.action import Joint

NEAR, REACH = 24, 0.3  # points around one, and how far they lie to either side, in prior standard deviations
SEED = 0
MORE = 160  # vectors of one family that are enough there for a ten-thousandth of a frequency


def in_few_vectors(hypothesis: Hypothesis, points: Sequence[np.ndarray], most: int) -> Hypothesis:
    """The same, good enough to tell windings apart; to be paired anew.

    Parameters
    ----------
    hypothesis : with a contact that is lost over an arc.
    points : coordinates all over what is searched, whose modes span the vectors (`JointBasis.condensed`).
    most : vectors of one family.
    """
    stages = []
    for stage in hypothesis.study.stages:
        samples = [s for z in points for s in _samples(hypothesis, stage, z)]
        stages.append(stage.condensed(samples, most) if samples else stage)
    return hypothesis.with_stages(tuple(stages))


def in_few_vectors_near(hypothesis: Hypothesis, z: np.ndarray, places: Sequence[int]) -> Hypothesis:
    """The same around a point, good enough to follow an optimum there: a tenth of a second's solution takes hundredths.

    Parameters
    ----------
    hypothesis : with a contact that is lost over an arc, in a model of its own.
    z : all coordinates.
    places : of those that will be moved: a winding's and an arc's.
    """
    return in_few_vectors(hypothesis, with_neighbours(hypothesis, [z], places), MORE)


def with_neighbours(
    hypothesis: Hypothesis, points: Sequence[np.ndarray], places: Sequence[int]
) -> list[np.ndarray]:
    """Some points, and others around each of them.

    Parameters
    ----------
    hypothesis : whose coordinates these are.
    points : coordinates.
    places : of those that will be moved.
    """
    found = []
    for z in points:
        found.append(z)
        for row in qmc.LatinHypercube(len(places), seed=SEED).random(NEAR):
            point = z.copy()
            point[list(places)] += REACH * (2 * row - 1)
            found.append(np.clip(point, *hypothesis.limits()))
    return found


def _samples(hypothesis: Hypothesis, stage: StageModel, z: np.ndarray) -> Iterator[tuple[Materials, Joint]]:
    """Materials and contact of a stage at a point; nothing where no body has its constants."""
    actions = hypothesis.actions(z)
    joints = [a.joint for a in actions if a.joint is not None and a.touches(stage.name, None)]
    if joints:
        try:
            yield hypothesis.materials(stage, z), joints[0]
        except StatorhomError:
            return
