"""A stage on a finer mesh, with all local fields of what breaks its symmetry: what the coarse one is off by there."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from statorhom.diagnose.stages.broken_response import Response, changes_of, own_examples, responses
from statorhom.diagnose.stages.refinement import Addition, Refinement
from statorhom.diagnose.stages.stage_model import StageModel, finely_layered, on_mesh
from statorhom.identify.residuals.model_error import ModelError
from statorhom.model.affine import Materials
from statorhom.model.broken.change import Change, PieceChange
from statorhom.model.convergence import ModeKey
from statorhom.physics.action import Action

STRONG = 0.015  # largest split from which on it matters: a tenth of that is what tests resolve
DEEP = 0.3  # part of some piece's stiffness that is gone or added: what is smooth has no such local fields
LARGEST = 250_000  # degrees of freedom of a finer mesh that is worth its time


def refinement(
    stage: StageModel,
    materials: Materials,
    actions: Sequence[Action],
    sizes: Sequence[float] = (),
    known: Refinement | None = None,
) -> Refinement | None:
    """What a finer mesh adds to what some effects do; None where they are too weak for that to matter.

    Parameters
    ----------
    stage : at the materials, with the mesh factors of its own mesh.
    materials : of all regions.
    actions : of the effects; what others change is not refined.
    sizes : of the effects (`Refinement.sizes`).
    known : what was made before; it is kept where it serves these as well.

    Raises
    ------
    SolverError
        If the changes leave a mass or stiffness that is not definite.
    """
    breaking = [a for a in actions if a.changes and a.label and a.touches(stage.name)]
    labels = frozenset(a.label for a in breaking if a.label)
    if known is not None and known.holds_at(labels, sizes):
        return known
    changes = changes_of(stage, materials, breaking)
    if not any(_is_deep(c) for c in changes):
        return None
    trainings = [a.training for a in breaking if a.training is not None]
    coarse = responses(stage, changes, trainings)
    if not _is_strong(coarse) or stage.finely_layered.mesh.full_dof > LARGEST:
        return None
    twin = _twin(stage, materials, breaking)
    fine = responses(twin, changes_of(twin, materials, breaking), trainings)
    return Refinement(labels, tuple(sizes), _additions(coarse, fine))


def _is_deep(change: Change) -> bool:
    return isinstance(change, PieceChange) and float(np.abs(change.weights).max(initial=0.0)) > DEEP


def _is_strong(found: Mapping[ModeKey, Response]) -> bool:
    return max((abs(one.split) for one in found.values()), default=0.0) > STRONG


def _additions(
    coarse: Mapping[ModeKey, Response], fine: Mapping[ModeKey, Response]
) -> dict[ModeKey, Addition]:
    return {
        key: Addition(fine[key].shift - one.shift, one.split, fine[key].split - one.split)
        for key, one in coarse.items()
        if key in fine
    }


def _twin(stage: StageModel, materials: Materials, actions: Sequence[Action]) -> StageModel:
    """The stage on the finer mesh, its named modes at the frequencies that both meshes' factors lead to."""
    density = finely_layered(stage.density)
    twin = on_mesh(stage.finely_layered, stage.setup, stage.tests, [materials], density)
    ours, theirs = stage.reference_keys, twin.reference_keys
    factors = {
        key: stage.error.factor(key) * ours[key].frequency_hz / mode.frequency_hz
        for key, mode in theirs.items()
        if key in ours
    }
    examples = own_examples(twin, materials, actions)
    return replace(twin, examples=examples, error=ModelError(factors), exact=True)
