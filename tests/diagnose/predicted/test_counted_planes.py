"""Node planes as a test's own measuring planes count them."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from small_stage import stage_of

from statorhom.diagnose.features.assignment import sought
from statorhom.diagnose.measured.measured_test import MeasuredShapes, MeasuredTest
from statorhom.diagnose.predicted.counted_planes import _possible, _with_fewer_planes, counted_at_planes
from statorhom.diagnose.predicted.prediction import PredictedMode
from statorhom.diagnose.stages.stage_model import StageModel
from statorhom.model.affine import Materials
from statorhom.model.convergence import mode_keys
from statorhom.model.radial_profile import radial_profile
from statorhom.model.stator_mode import StatorMode
from statorhom.study.modal_table import MeasuredMode

STAGE = stage_of(("stack",), 6000.0)


def wave(n: int, *parts: float) -> np.ndarray:
    """cos nπz/L at parts of the length."""
    return np.cos(n * np.pi * np.array(parts))[:, None]


@pytest.mark.parametrize("n", range(4))
def test_enough_planes_count_right(n: int) -> None:
    assert _possible(wave(n, 0.05, 0.35, 0.65, 0.95))[0][0] == n


def test_four_planes_count_four_node_planes_as_two() -> None:
    assert _possible(wave(4, 0.05, 0.35, 0.65, 0.95))[0][0] == 2


def test_a_faint_plane_leaves_both_counts_possible() -> None:
    assert _possible(np.array([[1.0], [-0.15], [1.0]])) == [(2, 0)]
    assert _possible(np.array([[1.0], [-0.05], [1.0]])) == [(0, 2)]


def test_a_shape_that_hardly_crosses_zero_may_not_do_so_on_another_mesh() -> None:
    """A (3, 2) of a table whose middle the diagnosing mesh moves by +1 % of the ends was named a mistaken mode."""
    half = [1.0, 0.65, 0.32, 0.11]
    assert _with_fewer_planes(np.array([*half, 0.01, *half[::-1]])[:, None]) == [(0, 2)]
    assert _with_fewer_planes(np.array([*half, 0.2, *half[::-1]])[:, None]) == [(0,)]
    assert _possible(np.array([-1.0, -0.02, 0.02, 1.0])[:, None]) == [(1, 3)]
    assert _possible(np.array([-1.0, -0.3, 0.3, 1.0])[:, None]) == [(1,)]


def predictions(stage: StageModel, materials: Materials) -> dict[Any, PredictedMode]:
    return {
        key: PredictedMode(key, mode, float(np.log(mode.frequency_hz)), 0j, 1e-3)
        for key, mode in mode_keys(stage.solve(materials).modes).items()
    }


def seen_at(
    *parts: float, stage: StageModel = STAGE, materials: Materials | None = None
) -> dict[Any, PredictedMode]:
    places, there = stage.model.mesh.length * np.array(parts), materials or stage.reference
    shapes = MeasuredShapes((), places, np.arange(12) * np.pi / 6, np.zeros((0, len(places), 12)))
    test = MeasuredTest(0, "free", "free", (), True, shapes=shapes)
    return counted_at_planes(stage, test, predictions(stage, there), there)


def test_planes_that_show_the_mode_give_its_own_count() -> None:
    found = seen_at(0.02, 0.14, 0.26, 0.38, 0.5, 0.62, 0.74, 0.86, 0.98)
    assert found
    assert all(mode.mode.axial in mode.shown for mode in found.values())


def test_two_planes_tell_odd_from_even_alone() -> None:
    for mode in seen_at(0.1, 0.9).values():
        assert mode.mode.axial is not None
        assert mode.mode.axial % 2 in mode.shown


def test_a_mode_is_counted_as_it_moves_at_these_materials() -> None:
    """A name that another mode bears at the reference says nothing of what the planes show of it here."""
    stage, parts = stage_of(("stack", "wound"), 12000.0), (0.05, 0.35, 0.65, 0.95)
    loose = loosened(stage.reference)
    found = seen_at(*parts, stage=stage, materials=loose)
    profile = radial_profile(stage.model.mesh, stage.model.mesh.length * np.array(parts))
    solved = stage.solve(loose)
    for mode in found.values():
        number, column = mode.mode.place
        problem = solved.problems[number]
        shape = problem.space.expand(problem.basis @ solved.vectors[number][:, [column]])
        counts = _possible(profile.orders(problem.space, shape))[0]
        assert mode.shown[: len(counts)] == counts
    at_reference = seen_at(*parts, stage=stage)
    # with the stack loose, the same name is a mode whose inner planes hardly move
    assert (at_reference[2, 2, 0].shown, found[2, 2, 0].shown) == ((2,), (2, 0))


def loosened(materials: Materials) -> Materials:
    """With a stack that is soft along the axis and in shear."""
    softer = np.ones((6, 6))
    softer[2, 2], softer[3:5, 3:5] = 0.3, 0.1
    softer[:2, 2] = softer[2, :2] = 0.5
    own = materials["lamination"]
    return {
        **materials,
        "lamination": replace(own, hooke=replace(own.hooke, matrix=own.hooke.matrix * softer)),
    }


def test_a_mode_is_paired_by_the_count_that_its_planes_show() -> None:
    own = StatorMode(3821.0, 2, 4, "radial", 1.0, 2, 0, 0)
    key = (2, 4, 0)
    predicted = {key: PredictedMode(key, own, float(np.log(3821.0)), 0j, 1e-3)}
    rows = (MeasuredMode(1, "1", 3820.0, order=2, axial=0),)
    test: Any = SimpleNamespace(recorded=True)
    shown = {key: replace(predicted[key], shown=(2, 0))}
    assert sought(test, rows, shown).within(1.0) == (key,)
    assert next(iter(predicted.values())).axial == 4


def test_where_nobody_knows_the_planes_some_may_be_missing() -> None:
    """A mode of a loose stack that two planes more or less say is one of five node planes, or of one."""
    along = np.array([-1.0, 0.41, -0.64, -0.78, 0.0, 0.78, 0.64, -0.41, 1.0])
    assert set(_with_fewer_planes(along[:, None])[0]) == {1, 5}
    # the ends of a loose stack move by themselves, and are measured
    ends = np.array([-1.0, 0.1, 0.5, 0.5, 0.0, -0.5, -0.5, -0.1, 1.0])
    assert set(_with_fewer_planes(ends[:, None])[0]) == {3}
    found = counted_at_planes(
        STAGE, MeasuredTest(0, "free", "free", ()), predictions(STAGE, STAGE.reference), STAGE.reference
    )
    assert all(mode.shown[0] == mode.mode.axial for mode in found.values())
    assert all(set(mode.shown) == {n} for (_, n, _), mode in found.items() if n < 2)
