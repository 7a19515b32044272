"""A basis for an effect that changes materials: the declared model's knows no others than its own.

A stack declared isotropic has no modes that slide; predicted from its shapes they would be far too stiff, and a refit
would look for its constants in the wrong place.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from statorhom.diagnose.fits.hypothesis import Hypothesis
from statorhom.diagnose.stages.stage_model import StageModel, with_snapshots
from statorhom.errors import StatorhomError
from statorhom.model.affine import Material, Materials

SNAPSHOTS = 3  # materials that are added
FAR = 0.3  # relative change of a Hooke entry from which on a basis has to know the material


def with_materials_of(hypothesis: Hypothesis, points: Sequence[np.ndarray]) -> Hypothesis:
    """The hypothesis, predicted well at materials that its effect makes too.

    Parameters
    ----------
    hypothesis : with the effect as its last one; it comes back as it is where none changes a material.
    points : all coordinates, with magnitudes of all sizes.
    """
    if not any(action.materials is not None for action in hypothesis.actions(points[0])):
        return hypothesis
    stages = []
    for stage in hypothesis.study.stages:
        snapshots = _materials(hypothesis, stage, _spread(points))
        stages.append(with_snapshots(stage, snapshots) if snapshots else stage)
    return replace(hypothesis, study=hypothesis.study.with_stages(tuple(stages)))


def _spread(points: Sequence[np.ndarray]) -> list[np.ndarray]:
    """The first, the last and those between."""
    places = np.unique(np.linspace(0, len(points) - 1, SNAPSHOTS).round().astype(int))
    return [points[i] for i in places]


def _materials(hypothesis: Hypothesis, stage: StageModel, points: Sequence[np.ndarray]) -> list[Materials]:
    """Materials of a stage that differ much from those of its basis."""
    found = []
    for z in points:
        try:
            acted = hypothesis.materials(stage, z)
        except StatorhomError:
            continue
        if any(_is_far(stage.reference[region], acted[region]) for region in acted):
            found.append(acted)
    return found


def _is_far(one: Material, other: Material) -> bool:
    return bool(np.any(np.abs(other.hooke.matrix - one.hooke.matrix) > FAR * np.abs(one.hooke.matrix)))
