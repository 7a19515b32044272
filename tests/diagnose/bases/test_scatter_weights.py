"""Splits by scatter against the solution with the wave in it, on a small mesh."""

from __future__ import annotations

from types import SimpleNamespace

import pytest
from small_stators import MATERIALS, ring_mesh

from statorhom.diagnose.bases.ring_basis import ring_basis
from statorhom.diagnose.stages.broken_response import responses
from statorhom.diagnose.stages.stage_model import StageModel
from statorhom.identify.residuals.model_error import ModelError
from statorhom.mesh import uniform
from statorhom.model.affine import assemble
from statorhom.model.broken.variations import wave
from statorhom.physics.effects.interlaminar_shear import sheared
from statorhom.physics.pieces import region_pieces

TOP = 9000.0
AMPLITUDE = 1e-4


@pytest.fixture(scope="module")
def stage() -> StageModel:
    """A stack so soft in shear that modes of one order bend or shear it."""
    model = assemble(ring_mesh(120.0, 90.0, 80.0, radial=1, axial=2, sectors=36))
    stack = {"lamination": sheared(MATERIALS["lamination"], 2e9, 30e9)}
    ring = ring_basis(model, [stack], TOP, range(5))
    keys = SimpleNamespace(name="stack")
    return StageModel(SimpleNamespace(keys=keys), (), ring, stack, ModelError(), uniform(1))


@pytest.mark.parametrize("order", [2, 3])
def test_weights_are_the_splits_by_a_wave_of_stiffness(stage: StageModel, order: int) -> None:
    pieces = region_pieces(stage.model.mesh, "lamination", stage.reference["lamination"])
    change = wave(stage.model.mesh, pieces, 0.0, harmonic=2 * order, amplitude=AMPLITUDE, inner=0.0)
    found = responses(stage, [change])
    checked = [key for key in found if key[0] == order]
    assert len(checked) >= 2
    for key in checked:
        assert found[key].split.real / AMPLITUDE == pytest.approx(stage.scattered[key], abs=0.06)


def test_modes_of_one_order_split_differently(stage: StageModel) -> None:
    weights = [weight for key, weight in stage.scattered.items() if key[0] == 2]
    assert max(weights) > 0.5
    assert min(weights) < 0.2
