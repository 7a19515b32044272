import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from statorhom.modes.gap_clusters import angle_clusters, gap_clusters


@settings(deadline=None)
@given(
    st.integers(2, 8),
    st.integers(2, 30),
    st.floats(1e-3, 1e3),
    st.floats(0.0, 0.08),
    st.integers(0, 2**32 - 1),
)
def test_scattered_planes_are_found_whatever_the_size(planes, points, size, scatter, seed):
    # scatter up to ± 8 % of the spacing, over a range of six decades of sizes
    rng = np.random.default_rng(seed)
    truth = rng.permutation(np.repeat(np.arange(planes), points))
    values = size * (truth + scatter * rng.uniform(-1, 1, truth.size))
    numbers = gap_clusters(values, 5e-3 * size * (planes - 1))
    if scatter < 0.05 or points >= 10:  # few widely scattered points may be anything
        np.testing.assert_array_equal(numbers, truth)


def test_a_plane_of_its_own_close_to_another_one_stays_apart():
    z = [*np.repeat([0.004, 0.028, 0.052, 0.076], 24).tolist(), 0.0074]
    assert gap_clusters(z, 5e-3 * 0.072).max() == 4


def test_one_plane_and_one_point():
    assert gap_clusters([1.0, 1.0, 1.0], 0.1).tolist() == [0, 0, 0]
    assert gap_clusters([3.0], 0.1).tolist() == [0]


def test_angles_around_zero_are_one():
    numbers, means = angle_clusters(np.radians([359.9, 0.1, 90.0, 180.1, 179.9, 270.0]), 5e-3)
    assert np.degrees(means) == pytest.approx([0.0, 90.0, 180.0, 270.0], abs=1e-6)
    assert numbers.tolist() == [0, 0, 1, 2, 2, 3]
