import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from material_strategies import any_hooke, rotations

from statorhom.materials.rotation import cylinder_axes, rotate, stress_rotation

VOIGT = [(0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1)]


def fourth_order(matrix):
    """C_ijkl of a Voigt stiffness matrix."""
    tensor = np.zeros((3, 3, 3, 3))
    for row, (i, j) in enumerate(VOIGT):
        for column, (k, m) in enumerate(VOIGT):
            for a, b in {(i, j), (j, i)}:
                for c, d in {(k, m), (m, k)}:
                    tensor[a, b, c, d] = matrix[row, column]
    return tensor


def voigt(tensor):
    return np.array([[tensor[i, j, k, m] for k, m in VOIGT] for i, j in VOIGT])


@settings(deadline=None)
@given(any_hooke(), rotations())
def test_rotation_is_that_of_the_fourth_order_tensor(hooke, axes):
    turned = np.einsum("ia,jb,kc,ld,abcd->ijkl", axes, axes, axes, axes, fourth_order(hooke.matrix))
    scale = np.abs(hooke.matrix).max()
    assert rotate(hooke.matrix, axes) == pytest.approx(voigt(turned), rel=1e-9, abs=1e-12 * scale)


@settings(deadline=None)
@given(rotations(), st.lists(st.floats(-1.0, 1.0), min_size=6, max_size=6))
def test_stress_rotation_turns_a_stress_tensor(axes, components):
    stress = np.zeros((3, 3))
    for value, (i, j) in zip(components, VOIGT, strict=True):
        stress[i, j] = stress[j, i] = value
    turned = axes @ stress @ axes.T
    assert stress_rotation(axes) @ components == pytest.approx([turned[i, j] for i, j in VOIGT], abs=1e-12)


@settings(deadline=None)
@given(rotations(), rotations())
def test_two_rotations_in_a_row_are_their_product(first, second):
    both = stress_rotation(second) @ stress_rotation(first)
    assert both == pytest.approx(stress_rotation(second @ first), abs=1e-12)


def test_a_batch_of_angles_equals_them_one_by_one():
    matrix = np.arange(36.0).reshape(6, 6)
    angles = np.linspace(0.0, 6.0, 12).reshape(3, 4)
    batch = rotate(matrix, cylinder_axes(angles))
    assert batch.shape == (3, 4, 6, 6)
    for index, theta in np.ndenumerate(angles):
        assert batch[index] == pytest.approx(rotate(matrix, cylinder_axes(theta)))


def test_columns_of_cylinder_axes_are_radial_tangential_axial():
    axes = cylinder_axes(np.radians(30.0))
    assert axes[:, 0] == pytest.approx([np.sqrt(0.75), 0.5, 0.0])
    assert axes[:, 1] == pytest.approx([-0.5, np.sqrt(0.75), 0.0])
    assert axes[:, 2] == pytest.approx([0.0, 0.0, 1.0])
