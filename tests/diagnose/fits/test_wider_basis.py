"""A basis that knows the materials an effect makes, against the full model."""

from __future__ import annotations

from types import SimpleNamespace

import pytest
from small_stators import MATERIALS, ring_mesh

from statorhom.diagnose.bases.ring_basis import ring_basis
from statorhom.diagnose.stages.stage_model import StageModel, with_snapshots
from statorhom.identify.residuals.model_error import ModelError
from statorhom.mesh import uniform
from statorhom.model.affine import assemble
from statorhom.model.convergence import mode_keys
from statorhom.model.free_modes import solve_free
from statorhom.physics.effects.interlaminar_shear import sheared

TOP = 9000.0
STIFF = {"lamination": MATERIALS["lamination"]}
SOFT = {"lamination": sheared(MATERIALS["lamination"], 2e9, 30e9)}


@pytest.fixture(scope="module")
def stage() -> StageModel:
    model = assemble(ring_mesh(120.0, 90.0, 80.0, radial=1, axial=2))
    ring = ring_basis(model, [STIFF], TOP, range(4))
    return StageModel(
        SimpleNamespace(keys=SimpleNamespace(name="stack")), (), ring, STIFF, ModelError(), uniform(1)
    )


def worst_error(stage: StageModel) -> float:
    full = mode_keys(solve_free(stage.model, SOFT, TOP, range(4)).modes)
    found = mode_keys(stage.solve(SOFT).modes)
    return max(
        abs(found[key].frequency_hz / mode.frequency_hz - 1) for key, mode in full.items() if key in found
    )


def test_modes_that_slide_are_predicted_from_snapshots_of_their_own(stage: StageModel) -> None:
    assert worst_error(stage) > 0.02  # a stiff stack's shapes do not slide
    assert worst_error(with_snapshots(stage, [SOFT])) < 1e-6


def test_what_belongs_to_the_reference_stays(stage: StageModel) -> None:
    keys = stage.reference_keys
    assert with_snapshots(stage, [SOFT]).reference_keys is keys
