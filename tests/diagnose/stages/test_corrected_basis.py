"""Modes that mix at the frequencies which a fine mesh gives them."""

from __future__ import annotations

import numpy as np
import pytest
from small_stage import stage_of

from statorhom.diagnose.stages.broken_response import responses
from statorhom.diagnose.stages.stage_model import StageModel
from statorhom.identify.residuals.model_error import ModelError
from statorhom.model.broken.attachments import footed_lump
from statorhom.model.broken.change import Change
from statorhom.model.broken.solve import solve_broken

TOP = 6000.0
PAIR = ((2, 0, 0), (2, 1, 0))


@pytest.fixture(scope="module")
def stack() -> StageModel:
    return stage_of(("stack",), TOP)


def lump(stage: StageModel, mass: float = 0.02) -> tuple[Change, ...]:
    length = stage.model.mesh.length
    return (footed_lump(stage.model.mesh, 0.4, 0.4 * length, mass, foot=0.01, height=0.01),)


def test_one_factor_for_all_modes_changes_no_relative_response_by_much(stack: StageModel) -> None:
    keys = stack.reference_keys
    other = stack.with_error(ModelError.of_factors(dict.fromkeys(keys, 0.99)))
    plain, scaled = (responses(s, lump(s)) for s in (stack, other))
    for key in ((2, 0, 0), (2, 1, 0), (3, 0, 0)):
        assert scaled[key].shift == pytest.approx(plain[key].shift, rel=0.02)
        assert abs(scaled[key].split - plain[key].split) < 0.02 * abs(plain[key].split)


def test_the_columns_stand_at_the_corrected_frequencies(stack: StageModel) -> None:
    error = ModelError.of_factors({key: 0.97 if key == (2, 1, 0) else 1.0 for key in stack.reference_keys})
    plain, corrected = stack.trained(()), stack.with_error(error).trained(())
    for key, place in corrected.columns.items():
        factor = error.factor(key) ** 2
        assert place.eigenvalue == pytest.approx(factor * plain.columns[key].eigenvalue)
    unbroken = solve_broken(corrected.basis, lump(stack, 1e-9), tolerance=None)
    for key in PAIR:
        expected = error.factor(key) * stack.reference_keys[key].frequency_hz
        assert np.abs(unbroken.frequencies_hz - expected).min() < 1e-4 * expected


def test_modes_that_come_nearer_to_each_other_mix_more(stack: StageModel) -> None:
    """A lump off the middle mixes (2, 0) and (2, 1)."""
    shares = []
    for factor in (1.0, 0.8):
        known = {key: factor if key[:2] == (2, 1) else 1.0 for key in stack.reference_keys}
        trained = stack.with_error(ModelError.of_factors(known)).trained(())
        modes = solve_broken(trained.basis, lump(stack), tolerance=None)
        own, other = (np.sum(modes.participation[trained.columns[k].numbers] ** 2, axis=0) for k in PAIR)
        shares.append(float(other[np.argmax(own)]))
    assert shares[1] > 2 * shares[0] > 0
