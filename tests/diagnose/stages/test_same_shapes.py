"""Modes bear the reference's names where their shapes are the reference's."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from small_stage import stage_of

from statorhom.diagnose.stages.same_shapes import reference_names, same_shapes
from statorhom.model.affine import Materials
from statorhom.model.convergence import ModeKey, mode_keys
from statorhom.model.stator_mode import StatorMode

STAGE = stage_of(("stack", "wound"), 12000.0)


def with_stiffness(factor: float) -> Materials:
    """Of a winding that is softer or stiffer."""
    own = STAGE.reference["winding"]
    return {
        **STAGE.reference,
        "winding": replace(own, hooke=replace(own.hooke, matrix=factor * own.hooke.matrix)),
    }


def test_at_the_reference_names_are_the_reference_s() -> None:
    solved = STAGE.solve(STAGE.reference)
    assert reference_names(STAGE, solved, solved.modes) == dict(STAGE.reference_keys)


def test_of_a_softer_winding_a_mode_keeps_the_name_of_its_shape() -> None:
    """Ranks shift, for modes of the winding become visible between those of the core."""
    solved = STAGE.solve(with_stiffness(0.1))
    found, own = reference_names(STAGE, solved, solved.modes), mode_keys(solved.modes)
    assert {m.place for m in found.values()} == {m.place for m in own.values()}
    renamed = {key for key, mode in found.items() if own.get(key) != mode}
    assert renamed
    for key in renamed & set(STAGE.reference_keys):
        assert likeness(key, found[key]) >= likeness(key, own.get(key))


def likeness(key: ModeKey, mode: StatorMode | None) -> float:
    """MAC of a mode of the softer winding with the reference's of a name."""
    if mode is None:
        return 0.0
    number, column = mode.place
    before = STAGE.reference_keys[key]
    if before.problem != number:
        return 0.0
    mass = STAGE.ring.problems[number].mass_matrix(STAGE.reference)
    own = STAGE.solve(STAGE.reference).vectors[number][:, before.column]
    other = STAGE.solve(with_stiffness(0.1)).vectors[number][:, column]
    return float((own @ mass @ other) ** 2)


def test_unlike_shapes_have_no_partner() -> None:
    own, others = np.eye(2, 4), np.array([[0.1, 0.95], [0.2, 0.1], [0.9, 0.0], [0.1, 0.0]])
    assert same_shapes(own, others) == [(0, 1)]
