"""Features of supported tests: the stator on springs, in the basis of its free modes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from statorhom.diagnose.features import Feature
from statorhom.diagnose.measured import MeasuredTest
from statorhom.diagnose.stage_model import StageModel
from statorhom.diagnose.study_model import StudyModel
from statorhom.physics.action import Action


def supported_features(
    study: StudyModel,
    stage: StageModel,
    test: MeasuredTest,
    values: Mapping[str, float],
    actions: Sequence[Action],
) -> list[Feature]:
    """Frequencies of a supported test."""
    del study, stage, test, values, actions
    return []
