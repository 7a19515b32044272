"""What breaks the symmetry does to the named modes of a stage."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from statorhom.diagnose.bases.shown_nodes import shown_nodes
from statorhom.diagnose.stages.order_profiles import broken_profile, radial_motion
from statorhom.diagnose.stages.stage_model import StageModel
from statorhom.model.affine import Materials
from statorhom.model.broken.change import Change
from statorhom.model.broken.named_response import Response, nearest_pair, response_of, seen_shares
from statorhom.model.broken.solve import solve_broken
from statorhom.model.convergence import ModeKey
from statorhom.physics.action import Action, Training

__all__ = ["Response", "changes_of", "own_examples", "responses"]


def responses(
    stage: StageModel, changes: Sequence[Change], trainings: Sequence[Training] = ()
) -> dict[ModeKey, Response]:
    """Response of every named mode that can still be told; `trainings` tell what the basis has to hold.

    Raises
    ------
    SolverError
        If the changes leave a mass or stiffness that is not definite.
    """
    trained = stage.trained(trainings)
    modes = solve_broken(trained.basis, changes, tolerance=None)
    shares = seen_shares(modes, trained.columns, radial_motion(stage, trained))
    shown = shown_nodes(modes, trained.columns, stage.reference_keys)
    found = {}
    for key, place in trained.columns.items():
        pair = nearest_pair(modes, place)
        if pair is not None:
            profile = broken_profile(stage, trained, modes, key, pair) if stage.heights_m else None
            response = response_of(modes, place, pair, shares[key])
            found[key] = replace(response, other_axial=shown.get(key), profile=profile)
    return found


def changes_of(stage: StageModel, materials: Materials, actions: Sequence[Action]) -> list[Change]:
    """All that actions change, on a stage's mesh."""
    return [c for a in actions if a.changes for c in a.changes(stage.model.mesh, materials)]


def own_examples(
    stage: StageModel, materials: Materials, actions: Sequence[Action]
) -> dict[str, tuple[tuple[Change, ...]]]:
    """What effects change in a stage, by the key of their training: a strong one's local fields are its own."""
    return {
        a.training.key: (a.changes(stage.model.mesh, materials),)
        for a in actions
        if a.training and a.changes and a.touches(stage.name)
    }
