"""What snapshots have in common does not depend on which of the two ways, few or many of them, finds it."""

from __future__ import annotations

import numpy as np
import pytest

from statorhom.diagnose.stages.supported_slopes import _principal


@pytest.mark.parametrize("count", [7, 19, 20, 21, 60])
def test_directions_are_orthonormal_and_hold_the_snapshots(count: int) -> None:
    rng = np.random.default_rng(count)
    unit = np.r_[np.full(12, 1e6), np.full(8, 1e-6)]  # as far apart as those of motion and loads
    root = unit[:, None] * rng.standard_normal((20, 20))
    norm = root @ root.T
    snapshots = rng.standard_normal((20, count)) / unit[:, None]
    chosen = _principal(norm, snapshots)
    assert chosen.shape[1] == min(20, count)
    np.testing.assert_allclose(chosen.T @ norm @ chosen, np.eye(chosen.shape[1]), atol=1e-9)
    left = snapshots - chosen @ (chosen.T @ norm @ snapshots)
    assert (
        np.einsum("ij,ik,kj->j", left, norm, left).max()
        < 1e-6 * np.einsum("ij,ik,kj->j", snapshots, norm, snapshots).max()
    )


def test_a_norm_that_sees_only_a_part_is_no_fault() -> None:
    rng = np.random.default_rng(1)
    root = rng.standard_normal((20, 12))
    chosen = _principal(root @ root.T, rng.standard_normal((20, 50)))
    assert chosen.shape[1] == 12
