import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from statorhom.errors import IdentificationError
from statorhom.modes.circumferential_grid import different_angles, find_grid


@given(count=st.integers(3, 60), offset=st.floats(-10, 10))
@settings(deadline=None, max_examples=40)
def test_full_grid_is_found_at_any_offset(count, offset):
    grid = find_grid(offset + 2 * np.pi * np.arange(count) / count)
    assert (grid.count, grid.equidistant) == (count, True)
    steps = (offset - grid.offset_rad) * count / (2 * np.pi)
    assert steps == pytest.approx(round(steps), abs=1e-6)


def test_missing_and_repeated_points_do_not_change_the_grid():
    angles = 2 * np.pi * np.arange(24) / 24
    grid = find_grid(np.concatenate([np.delete(angles, [3, 4, 11, 20]), angles[:3] + 2 * np.pi]))
    assert (grid.count, grid.equidistant, grid.highest_order) == (24, True, 12)


def test_scattered_angles_keep_their_grid():
    scatter = np.deg2rad(np.random.default_rng(3).uniform(-0.5, 0.5, 24))
    assert find_grid(2 * np.pi * np.arange(24) / 24 + scatter).count == 24


def test_uneven_angles_have_no_grid():
    grid = find_grid([0.0, 0.31, 0.95, 1.7, 3.3, 4.1, 5.9])
    assert (grid.equidistant, grid.count, grid.highest_order) == (False, 7, 3)


def test_fewer_than_three_angles_are_refused():
    with pytest.raises(IdentificationError, match=r"2 different angles.*measure at 3 or more"):
        find_grid([0.0, 1.0, 1.0 + 2 * np.pi])


def test_different_angles_count_across_zero():
    assert different_angles([-1e-5, 1e-5, 2 * np.pi - 1e-5, 1.0]) == 2
