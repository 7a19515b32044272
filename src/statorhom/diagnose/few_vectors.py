"""A hypothesis whose arcs of lost contact have modes in few vectors: for searches that ask thousands of times."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from statorhom.diagnose.hypothesis import Hypothesis
from statorhom.diagnose.stage_model import StageModel
from statorhom.errors import StatorhomError
from statorhom.model.affine import Materials
from statorhom.physics.action import Joint


def in_few_vectors(hypothesis: Hypothesis, points: Sequence[np.ndarray]) -> Hypothesis:
    """The same, good enough to tell windings apart; to be paired anew.

    Parameters
    ----------
    hypothesis : with a contact that is lost over an arc.
    points : coordinates all over what is searched, whose modes span the vectors (`JointBasis.condensed`).
    """
    stages = []
    for stage in hypothesis.study.stages:
        samples = [s for z in points for s in _samples(hypothesis, stage, z)]
        stages.append(stage.condensed(samples) if samples else stage)
    return replace(hypothesis, study=hypothesis.study.with_stages(tuple(stages)), held=None)


def _samples(hypothesis: Hypothesis, stage: StageModel, z: np.ndarray) -> Iterator[tuple[Materials, Joint]]:
    """Materials and contact of a stage at a point; nothing where no body has its constants."""
    actions = hypothesis.actions(z)
    joints = [a.joint for a in actions if a.joint is not None and a.touches(stage.name, None)]
    if joints:
        try:
            yield hypothesis.materials(stage, z), joints[0]
        except StatorhomError:
            return
