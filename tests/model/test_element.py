import numpy as np
import pytest

from statorhom.model.element import REFERENCE_NODES, gauss_table, shape_functions, shape_values

POINTS = np.random.default_rng(1).random((7, 3))


def test_a_shape_function_is_one_at_its_node_and_zero_at_the_others():
    values, _ = shape_functions(REFERENCE_NODES)
    np.testing.assert_allclose(values, np.eye(20), atol=1e-14)


def test_the_functions_reproduce_every_quadratic_and_its_gradient():
    def quadratic(x):
        return 2 + x[:, 0] * x[:, 1] - 3 * x[:, 2] ** 2 + x[:, 1] * x[:, 2] + x[:, 0] ** 2 - x[:, 1]

    x, y, z = POINTS.T
    gradient = np.column_stack([y + 2 * x, x + z - 1, -6 * z + y])
    values, gradients = shape_functions(POINTS)
    np.testing.assert_allclose(values @ quadratic(REFERENCE_NODES), quadratic(POINTS), rtol=1e-13)
    at_nodes = np.einsum("qai,a->qi", gradients, quadratic(REFERENCE_NODES))
    np.testing.assert_allclose(at_nodes, gradient, atol=1e-12)


def test_the_closed_form_is_the_same_family():
    np.testing.assert_allclose(shape_values(POINTS), shape_functions(POINTS)[0], atol=1e-14)
    np.testing.assert_allclose(shape_values(REFERENCE_NODES), np.eye(20), atol=1e-15)


def test_gradients_are_the_derivatives_of_the_values():
    step = 1e-6
    _, gradients = shape_functions(POINTS)
    for axis, shift in enumerate(step * np.eye(3)):
        difference = (shape_functions(POINTS + shift)[0] - shape_functions(POINTS - shift)[0]) / (2 * step)
        np.testing.assert_allclose(gradients[:, :, axis], difference, atol=1e-8)


@pytest.mark.parametrize("powers", [(0, 0, 0), (5, 5, 5), (4, 1, 2)])
def test_the_gauss_points_integrate_degree_five_in_every_direction(powers):
    # the positions of the Gauss points, from the isoparametric identity
    table = gauss_table()
    points = table.values @ REFERENCE_NODES
    integral = table.weights @ np.prod(points ** np.array(powers), axis=1)
    assert integral == pytest.approx(np.prod(1 / (np.array(powers) + 1.0)), rel=1e-13)


def test_the_table_has_27_points_and_cannot_be_changed():
    table = gauss_table()
    assert table.values.shape == (27, 20)
    assert gauss_table() is table
    for array in (table.values, table.gradients, table.weights):
        assert not array.flags.writeable
