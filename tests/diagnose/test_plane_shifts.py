"""Where the points of a plane contradict each other, their mean says nothing of a sensor."""

from __future__ import annotations

import numpy as np
import pytest

from statorhom.diagnose.plane_shifts import _by_plane

PLANES = (0.01, 0.04)
LOSS = 0.01
SD = 1e-5


def shifts(scatter: float, points: int = 24) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Heights, shifts and their standard deviations of two planes whose poles lie 1e-3 apart."""
    rng = np.random.default_rng(3)
    heights = np.repeat(PLANES, points)
    moved = np.where(heights > PLANES[0], 5e-4, -5e-4) + scatter * rng.standard_normal(len(heights))
    return heights, moved, np.full(len(heights), SD)


def test_points_that_agree_tell_the_shift_of_their_plane() -> None:
    found = _by_plane("1", *shifts(SD), LOSS)
    assert found is not None
    assert found.shift == pytest.approx([-5e-4, 5e-4], abs=1e-5)
    assert np.all(found.sd < SD)


def test_points_that_contradict_each_other_do_not() -> None:
    assert _by_plane("1", *shifts(20 * SD), LOSS) is None


def test_one_plane_tells_no_trend() -> None:
    heights, moved, sd = shifts(SD)
    assert _by_plane("1", heights[:24], moved[:24], sd[:24], LOSS) is None
