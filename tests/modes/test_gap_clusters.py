import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from statorhom.modes.gap_clusters import angle_clusters, gap_clusters

RESOLUTION = 5e-3


def scattered(planes, points, scatter, seed):
    """Planes one apart, their points off by up to ± the scatter: values and the planes they belong to."""
    rng = np.random.default_rng(seed)
    truth = rng.permutation(np.repeat(np.arange(planes), points))
    return truth + scatter * rng.uniform(-1, 1, truth.size), truth


@settings(deadline=None)
@given(
    st.integers(2, 8),
    st.integers(2, 30),
    st.floats(1e-3, 1e3),
    st.floats(0.0, 0.034),
    st.integers(0, 2**32 - 1),
)
def test_scattered_planes_are_found_whatever_the_size(planes, points, size, scatter, seed):
    # up to ± 3.4 % of the spacing a gap within a plane (0.068) is nearer to the resolution (0.005) than to
    # that between planes (0.932), as ratios, however few the points are
    values, truth = scattered(planes, points, scatter, seed)
    numbers = gap_clusters(size * values, RESOLUTION * size * (planes - 1))
    np.testing.assert_array_equal(numbers, truth)


def test_two_planes_of_two_points_at_the_ends_of_their_scatter():
    assert gap_clusters([-0.034, 0.034, 0.966, 1.034], RESOLUTION).tolist() == [0, 0, 1, 1]


@pytest.mark.parametrize("planes", range(2, 9))
@pytest.mark.parametrize("seed", range(5))
def test_many_points_may_scatter_further(planes, seed):
    # their gaps leave no jump below that to the spacing; few points scattered so far may be anything
    values, truth = scattered(planes, 10, 0.08, seed)
    np.testing.assert_array_equal(gap_clusters(values, RESOLUTION * (planes - 1)), truth)


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
