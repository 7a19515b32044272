import numpy as np
import pytest

from statorhom.modes.stray_angles import stray_angles

GRID = np.radians(np.arange(0, 360, 15.0))


@pytest.mark.parametrize("extra_deg", [[4.0], [7.5], [3.0, 200.0], []])
def test_only_points_beside_the_grid_are_stray(extra_deg):
    angles = np.concatenate([GRID, np.radians(extra_deg)])
    assert np.flatnonzero(stray_angles(angles)).tolist() == list(range(24, 24 + len(extra_deg)))


def test_without_a_grid_nothing_is_stray():
    angles = np.random.default_rng(3).uniform(0, 2 * np.pi, 20)
    assert not stray_angles(angles).any()


def test_missing_angles_do_not_make_the_others_stray():
    assert not stray_angles(np.delete(GRID, [1, 5, 6])).any()
