"""Models of an explanation's own: basis, mesh factors, local fields and machine where the explanation is."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import replace

import numpy as np

from statorhom.diagnose.contacts.joint_training import KnownArc
from statorhom.diagnose.fits.hypothesis import Hypothesis
from statorhom.diagnose.stages.changed_machine import scaled, typed
from statorhom.diagnose.stages.stage_model import StageModel, mesh_error, with_reference
from statorhom.errors import StatorhomError
from statorhom.model.affine import Materials
from statorhom.model.broken.change import Change
from statorhom.physics.action import Action

AROUND = 1 / 1.1, 1.1  # times its own arc, at which a contact that is lost over one is solved
ITSELF = (1.0,)  # the same of a rival: each arc that is solved takes as long as all else
NEAR = 0.015  # of ln(dimension): half of how far to either side a cubic about a machine is solved


def in_its_own_model(
    hypothesis: Hypothesis,
    z: np.ndarray,
    *,
    quick: bool = False,
    elsewhere: Sequence[np.ndarray] = (),
    around: tuple[float, ...] = AROUND,
) -> Hypothesis:
    """With basis and mesh factors of its own materials, and the local fields of its effects; to be paired anew.

    Parameters
    ----------
    hypothesis, z : what, and where.
    quick : whether the old mesh factors do, and the local fields that a basis holds of any such effects.
    elsewhere : other coordinates, of which the contact is solved too where it is lost over an arc.
    around : times an effect's own arc, at which its contact is solved.

    Raises
    ------
    StatorhomError
        If no stator has these constants.
    """
    actions, stages = hypothesis.actions(z), []
    for stage in hypothesis.study.stages:
        materials = hypothesis.materials(stage, z)
        arcs = (*_arcs(actions, around), *_arcs_elsewhere(hypothesis, stage, elsewhere))
        near = with_reference(stage, materials, arcs, {} if quick else _examples(stage, materials, actions))
        if not quick:
            near = near.with_error(mesh_error(stage.setup, near.ring, materials, stage.density))
        stages.append(near)
    moved = replace(hypothesis, study=hypothesis.study.with_stages(tuple(stages)), held=None)
    return near_its_machine(moved, z)


def _examples(
    stage: StageModel, materials: Materials, actions: Sequence[Action]
) -> dict[str, tuple[tuple[Change, ...]]]:
    """What effects change in a stage, by the key of their training: a strong one's local fields are its own."""
    return {
        a.training.key: (a.changes(stage.model.mesh, materials),)
        for a in actions
        if a.training and a.changes and a.touches(stage.name)
    }


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
        with suppress(StatorhomError):
            materials = hypothesis.materials(stage, z)
            yield from (arc._replace(materials=materials) for arc in _arcs(hypothesis.actions(z), ITSELF))


def near_its_machine(hypothesis: Hypothesis, z: np.ndarray) -> Hypothesis:
    """Other dimensions seen from the machine that has those of z; the same where none is far."""
    if not is_far(hypothesis, z):
        return hypothesis
    stages = tuple(stage.near_machines(_machines(hypothesis, z)) for stage in hypothesis.study.stages)
    return replace(hypothesis, study=hypothesis.study.with_stages(stages))


def is_far(hypothesis: Hypothesis, z: np.ndarray) -> bool:
    """Whether an effect has a dimension far from the machine that it is seen from."""
    study = hypothesis.study
    known = study.stages[0].machines
    away = {name: abs(t - known.get(name, 0.0)) for name, t in _machines(hypothesis, z).items()}
    return any(t > NEAR * scaled(study, name) for name, t in away.items())


def _machines(hypothesis: Hypothesis, z: np.ndarray) -> dict[str, float]:
    """Change of ln of every dimension that an effect corrects."""
    return {
        name: float(np.log(value / typed(hypothesis.study, name)))
        for action in hypothesis.actions(z)
        for name, value in action.dimensions.items()
    }
