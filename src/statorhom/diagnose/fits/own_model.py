"""Models of an explanation's own: basis, mesh factors, local fields and machine where the explanation is."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import replace

import numpy as np

from statorhom.diagnose.contacts.joint_solution import ROUGH
from statorhom.diagnose.contacts.joint_training import KnownArc
from statorhom.diagnose.fits.hypothesis import Hypothesis
from statorhom.diagnose.fits.new_step import SNAPSHOTS
from statorhom.diagnose.fits.valleys import trials_around
from statorhom.diagnose.stages.broken_response import own_examples
from statorhom.diagnose.stages.constants import new_constants
from statorhom.diagnose.stages.dimension_response import scaled, typed
from statorhom.diagnose.stages.finer_twin import refinement
from statorhom.diagnose.stages.redrawn_study import redrawn
from statorhom.diagnose.stages.stage_model import StageModel, mesh_error, with_reference
from statorhom.diagnose.stages.study_model import StudyModel
from statorhom.errors import GeometryError, StatorhomError
from statorhom.model.affine import Materials
from statorhom.physics.action import Action

AROUND = 1 / 1.1, 1.1  # times its own arc, at which a contact that is lost over one is solved
ITSELF = (1.0,)  # the same of a rival: each arc that is solved takes as long as all else
NEAR = 0.015  # of ln(dimension): half of how far to either side of the drawn machine its cubic is solved
SEED = 0  # of the draw of materials that a machine drawn anew knows beside its own


def in_its_own_model(
    hypothesis: Hypothesis,
    z: np.ndarray,
    *,
    quick: bool = False,
    elsewhere: Sequence[np.ndarray] = (),
    around: tuple[float, ...] = AROUND,
) -> Hypothesis:
    """With basis and mesh factors of its own materials, and the local fields of its effects; to be paired anew.

    What strong effects do is solved on a finer mesh as well, and what that adds is added from there on.

    Parameters
    ----------
    hypothesis, z : what, and where.
    quick : whether the old mesh factors do, and the local fields that a basis holds of any such effects.
    elsewhere : other coordinates, of which the contact is solved too where it is lost over an arc, roughly.
    around : times an effect's own arc, at which its contact is solved.

    Raises
    ------
    StatorhomError
        If no stator has these constants.
    """
    drawn = on_its_own_machine(hypothesis, z)
    actions, stages = hypothesis.actions(z), []
    for stage in drawn.study.stages:
        materials = drawn.materials(stage, z)
        arcs = (*_arcs(actions, around), *_arcs_elsewhere(drawn, stage, elsewhere))
        near = with_reference(
            stage, materials, arcs, {} if quick else own_examples(stage, materials, actions)
        )
        if not quick and drawn is hypothesis:
            near = near.with_error(mesh_error(near, materials))
            told = refinement(near, materials, actions, _sizes(hypothesis, z), stage.refinement)
            near = replace(near, refinement=told)
        stages.append(near)
    return drawn.with_stages(tuple(stages))


def on_its_own_machine(hypothesis: Hypothesis, z: np.ndarray) -> Hypothesis:
    """With a model of the machine that has its dimensions, to be paired anew.

    The same where they are near its model's, or none can be drawn.

    Raises
    ------
    StatorhomError
        If no stator has these constants.
    """
    if not is_far(hypothesis, z):
        return hypothesis

    def known(study: StudyModel, stage: StageModel) -> list[Materials]:
        there = replace(hypothesis, study=study)
        elsewhere = trials_around(z, new_constants(study.constants, stage.name), SEED)[1:SNAPSHOTS]
        return [there.materials(stage, z), *_possible(there, stage, elsewhere)]

    try:
        study = redrawn(hypothesis.study, _dimensions(hypothesis, z), known)
    except GeometryError:
        return hypothesis
    return replace(hypothesis, study=study, held=None)


def _possible(hypothesis: Hypothesis, stage: StageModel, points: Sequence[np.ndarray]) -> Iterator[Materials]:
    """Materials of a stage at some points, where there are such."""
    for z in points:
        with suppress(StatorhomError):
            yield hypothesis.materials(stage, z)


def is_far(hypothesis: Hypothesis, z: np.ndarray) -> bool:
    """Whether an effect has a dimension far from the machine that is drawn."""
    study = hypothesis.study
    away = {n: np.log(value / typed(study, n)) for n, value in _dimensions(hypothesis, z).items()}
    return any(abs(t) > NEAR * scaled(study, n) for n, t in away.items())


def _dimensions(hypothesis: Hypothesis, z: np.ndarray) -> dict[str, float]:
    """What effects correct, "section.key" → value."""
    return {name: value for action in hypothesis.actions(z) for name, value in action.dimensions.items()}


def _sizes(hypothesis: Hypothesis, z: np.ndarray) -> list[float]:
    """Of the effects: coordinates that tell no place."""
    own = zip(hypothesis.parameters, z[hypothesis.constants :].tolist(), strict=True)
    return [u for (i, j), u in own if not hypothesis.candidates[i].parameters[j].located]


def _arcs(actions: Sequence[Action], around: Sequence[float]) -> tuple[KnownArc, ...]:
    """Around those of a contact that is weaker over an arc."""
    arcs = [
        (a.joint.arc[1], a.joint.ratio) for a in actions if a.joint is not None and a.joint.arc is not None
    ]
    return tuple(KnownArc(min(w * f, 2 * np.pi), q / f**2) for w, q in arcs for f in around)


def _arcs_elsewhere(
    hypothesis: Hypothesis, stage: StageModel, points: Sequence[np.ndarray]
) -> Iterator[KnownArc]:
    """Of other coordinates, with the materials there; none where no stator has these."""
    for z in points:
        for materials in _possible(hypothesis, stage, [z]):
            arcs = _arcs(hypothesis.actions(z), ITSELF)
            yield from (arc._replace(materials=materials, rounds=ROUGH) for arc in arcs)
