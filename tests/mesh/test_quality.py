import numpy as np
import pytest

from statorhom.mesh.quality import scaled_jacobians

SQUARE = np.array([(0, 0), (1, 0), (1, 1), (0, 1), (0.5, 0), (1, 0.5), (0.5, 1), (0, 0.5)], dtype=float)
QUAD = np.arange(8)


def test_rectangles_are_perfect_at_any_size_and_angle():
    turn = np.array([[np.cos(0.3), -np.sin(0.3)], [np.sin(0.3), np.cos(0.3)]])
    assert scaled_jacobians((SQUARE * (1e-3, 7.0)) @ turn.T, QUAD) == pytest.approx(1.0)


def test_a_parallelogram_has_the_sine_of_its_angle():
    sheared = SQUARE @ np.array([[1.0, 0.0], [1.0, 1.0]])
    assert scaled_jacobians(sheared, QUAD) == pytest.approx(np.sin(np.pi / 4))


@pytest.mark.parametrize("node", range(4))
def test_a_corner_pulled_over_the_diagonal_folds_the_cell(node):
    points = SQUARE.copy()
    points[node] = points[(node + 2) % 4] * 0.8 + points[node] * 0.2
    for middle, ends in zip(range(4, 8), [(0, 1), (1, 2), (2, 3), (3, 0)], strict=True):
        points[middle] = points[list(ends)].mean(axis=0)
    assert scaled_jacobians(points, QUAD) < 0


def test_a_side_that_bulges_through_its_cell_folds_it():
    points = SQUARE.copy()
    points[4] = (0.5, 1.2)
    assert scaled_jacobians(points, QUAD) < 0


def test_a_clockwise_cell_is_negative_and_shapes_are_kept():
    clockwise = QUAD[[0, 3, 2, 1, 7, 6, 5, 4]]
    found = scaled_jacobians(SQUARE, np.array([[QUAD, clockwise]]))
    np.testing.assert_allclose(found, [[1.0, -1.0]])
