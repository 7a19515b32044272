"""Node planes that modes of an uneven stack show, against the motion of its surface."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest
from small_stage import stage_of

from statorhom.diagnose.bases.shown_nodes import shown_nodes
from statorhom.diagnose.features.assignment import sought
from statorhom.diagnose.measured.measured_test import MeasuredTest
from statorhom.diagnose.predicted.prediction import PredictedMode
from statorhom.diagnose.stages.stage_model import StageModel
from statorhom.model.affine import hooke_coefficients
from statorhom.model.broken.change import Change
from statorhom.model.broken.layers import radial_layers
from statorhom.model.broken.solve import BrokenModes, solve_broken
from statorhom.model.broken.variations import gradient
from statorhom.model.radial_profile import node_planes
from statorhom.model.stator_mode import StatorMode
from statorhom.model.surface import surface_points
from statorhom.study.modal_table import MeasuredMode

TOP = 12000.0
PLANES, ANGLES = 9, 24


@pytest.fixture(scope="module")
def stack() -> StageModel:
    return stage_of(("stack",), TOP)


def uneven(stage: StageModel, slope: float) -> tuple[Change, ...]:
    mesh = stage.model.mesh
    entries = hooke_coefficients(stage.reference["lamination"].hooke)
    parts = radial_layers(mesh, "lamination", entries, 1, by_height=True)
    return (gradient(parts, lambda z: slope * (2 * z / mesh.length - 1.0)),)


def counted(stage: StageModel, modes: BrokenModes, number: int, order: int) -> int:
    """Sign changes along the axis of the surface's motion of an order, at the angle where it is largest."""
    z = np.linspace(0.04, 0.96, PLANES) * stage.model.mesh.length
    angles = 2 * np.pi * np.arange(ANGLES) / ANGLES
    points = surface_points(stage.model.mesh, np.tile(angles, PLANES), np.repeat(z, ANGLES))
    radial = modes.motion(points)[:, 0, number].reshape(PLANES, ANGLES)
    wave = radial @ np.exp(-1j * order * angles)
    turned = (wave * np.exp(-0.5j * np.angle(np.sum(wave**2)))).real
    return int(node_planes(turned[:, None])[0])


def test_modes_that_mix_may_be_counted_by_either(stack: StageModel) -> None:
    trained = stack.trained(())
    modes = solve_broken(trained.basis, uneven(stack, 0.7), tolerance=None)
    found = shown_nodes(modes, trained.columns, stack.reference_keys)
    # the breathing modes lie near each other
    assert found[0, 0, 0] == 1
    assert (2, 0, 0) not in found
    for key, other in found.items():
        numbers = trained.columns[key].numbers
        own = int(np.argmax(np.sum(modes.participation[numbers] ** 2, axis=0)))
        assert counted(stack, modes, own, key[0]) in (key[1], other)
    breathing = int(np.argmax(modes.participation[trained.columns[0, 0, 0].cosine] ** 2))
    assert counted(stack, modes, breathing, 0) == 1


def test_in_an_even_stack_every_mode_shows_its_own(stack: StageModel) -> None:
    trained = stack.trained(())
    modes = solve_broken(trained.basis, uneven(stack, 1e-6), tolerance=None)
    assert shown_nodes(modes, trained.columns, stack.reference_keys) == {}


@pytest.mark.parametrize(("label", "partner"), [(1, (2, 1, 1)), (2, (2, 1, 1)), (0, None)])
def test_a_line_is_paired_by_either_count(label: int, partner: tuple[int, int, int] | None) -> None:
    line = MeasuredMode(1, "1", 8000.0, order=2, axial=label)
    test = MeasuredTest(0, "t", "free", (line,), True, (), ())
    weak = StatorMode(8100.0, 2, 1, "radial", 0.1, 2, 0, 0)
    far = StatorMode(10300.0, 2, 2, "radial", 0.5, 2, 0, 1)
    predicted = {
        (2, 1, 1): PredictedMode((2, 1, 1), weak, float(np.log(8100.0)), 0j, 0.0, other_axial=2),
        (2, 2, 0): PredictedMode((2, 2, 0), far, float(np.log(10300.0)), 0j, 0.0),
    }
    assert sought(test, (line,), predicted).within(1.0) == (partner,)


def test_a_band_without_modes_shows_none() -> None:
    none = SimpleNamespace(participation=np.zeros((4, 0)))
    columns = {(2, 0, 0): SimpleNamespace(numbers=[0, 1]), (2, 1, 0): SimpleNamespace(numbers=[2, 3])}
    assert shown_nodes(none, columns, {}) == {}  # type: ignore[arg-type]
