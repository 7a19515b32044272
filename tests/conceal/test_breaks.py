"""What breaks a true stator's symmetry where several things do so in one place."""

from __future__ import annotations

import numpy as np
import pytest
from small_stators import pressed_sheets, stator_mesh

from statorhom.conceal.breaks import AxialSlope, Break, Strip, Wave, all_changes
from statorhom.conceal.ground import StageGround
from statorhom.model.affine import assemble
from statorhom.model.broken.change import PieceChange

RATIO = 0.3


SLOPE = AxialSlope((pressed_sheets(-0.8), pressed_sheets(), pressed_sheets(0.8)))


@pytest.fixture(scope="module")
def ground() -> StageGround:
    model = assemble(stator_mesh(12))
    return StageGround(model, {"lamination": pressed_sheets()}, None, 1000.0, 5000.0)


def stiffness(ground: StageGround, breaks: tuple[Break, ...]) -> np.ndarray:
    """Of one half pitch."""
    K = ground.model.stiffness_matrix(ground.materials).toarray()
    for change in all_changes(breaks, ground):
        assert isinstance(change, PieceChange) and change.stiffness is not None
        K = K + change.stiffness.matrix(change.weights[:, 0]).toarray()
    return np.asarray(K)


def test_a_strip_is_a_part_of_the_modulus_beside_it(ground: StageGround) -> None:
    # so wide and deep that it is all there is
    whole = Strip(0.0, 2 * np.pi, 2 * ground.mesh.outer_radius, RATIO)
    alone = stiffness(ground, (SLOPE,))
    both = stiffness(ground, (whole, SLOPE))
    # layers are integrated by other points than whole elements
    np.testing.assert_allclose(both, RATIO * alone, atol=5e-4 * np.abs(alone).max())
    np.testing.assert_allclose(stiffness(ground, (SLOPE, whole)), both, atol=1e-9 * np.abs(alone).max())


def test_the_soft_end_of_a_soft_strip_keeps_some_stiffness(ground: StageGround) -> None:
    strip = Strip(0.0, 0.3, 0.5 * ground.mesh.outer_radius, 0.1)
    lowest = np.linalg.eigvalsh(stiffness(ground, (strip, SLOPE)))[0]
    size = np.abs(stiffness(ground, ())).max()
    assert lowest > -1e-9 * size
    # changes that were only added would leave less than none
    added = stiffness(ground, (strip,)) + stiffness(ground, (SLOPE,)) - stiffness(ground, ())
    assert np.linalg.eigvalsh(added)[0] < -1e-6 * size


def test_what_does_not_meet_is_added(ground: StageGround) -> None:
    strip, wave = Strip(0.4, 0.2, 0.01, RATIO), Wave(4, 0.05, 0.1)
    parts = [stiffness(ground, one) for one in ((strip,), (wave,), ())]
    both = stiffness(ground, (strip, wave))
    np.testing.assert_allclose(both, parts[0] + parts[1] - parts[2], atol=1e-9 * np.abs(both).max())
