import dataclasses

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from material_strategies import any_hooke, isotropic, rotations, transversely_isotropic

from statorhom.errors import MaterialError
from statorhom.materials.hooke import Hooke
from statorhom.materials.orthotropic import Orthotropic
from statorhom.materials.rotation import cylinder_axes

WOOD = Orthotropic(1.0e9, 0.5e9, 12.0e9, 0.4, 0.03, 0.02, 0.05e9, 0.7e9, 0.8e9).hooke()
# from Voigt stiffness to Mandel's basis, where a rotation is an orthogonal matrix
MANDEL = np.diag(np.sqrt([1.0, 1.0, 1.0, 2.0, 2.0, 2.0]))


def test_nothing_of_it_can_be_changed():
    with pytest.raises(dataclasses.FrozenInstanceError):
        WOOD.matrix = np.eye(6)
    with pytest.raises(ValueError, match="read-only"):
        WOOD.matrix[0, 0] = 1.0
    with pytest.raises(ValueError, match="read-only"):
        WOOD.compliance[0, 0] = 1.0


def test_it_keeps_its_own_copy():
    entries = np.eye(6)
    hooke = Hooke(entries)
    entries[0, 0] = 5.0
    assert hooke.matrix[0, 0] == 1.0


@pytest.mark.parametrize(
    ("matrix", "reason"),
    [
        (np.eye(3), "6 × 6"),
        (np.full((6, 6), np.nan), "finite"),
        (np.eye(6) + 0.1 * np.eye(6, k=1), "symmetric"),
    ],
)
def test_what_is_no_hooke_matrix_is_refused(matrix, reason):
    with pytest.raises(MaterialError, match=reason):
        Hooke(matrix)


def test_a_singular_matrix_has_no_compliance():
    with pytest.raises(MaterialError, match="singular"):
        _ = Hooke(np.diag([1.0, 1.0, 1.0, 1.0, 1.0, 0.0])).compliance


def test_an_indefinite_matrix_is_named_with_its_eigenvalue():
    matrix = np.eye(6)
    matrix[0, 1] = matrix[1, 0] = 2.0
    with pytest.raises(MaterialError, match=r"^winding: must be positive definite.*-1 Pa$"):
        Hooke(matrix).check_positive_definite("winding")
    WOOD.check_positive_definite("wood")


@settings(deadline=None)
@given(any_hooke(), rotations())
def test_rotation_keeps_the_invariants(hooke, axes):
    before = np.linalg.eigvalsh(MANDEL @ hooke.matrix @ MANDEL)
    after = np.linalg.eigvalsh(MANDEL @ hooke.rotated(axes).matrix @ MANDEL)
    assert after == pytest.approx(before, rel=1e-9, abs=1e-12 * before[-1])


@settings(deadline=None)
@given(any_hooke(), rotations())
def test_turning_back_restores_the_matrix(hooke, axes):
    back = hooke.rotated(axes).rotated(axes.T).matrix
    assert back == pytest.approx(hooke.matrix, rel=1e-9, abs=1e-11 * np.abs(hooke.matrix).max())


@settings(deadline=None)
@given(isotropic(), rotations())
def test_an_isotropic_material_does_not_feel_a_rotation(material, axes):
    matrix = material.hooke().matrix
    assert material.hooke().rotated(axes).matrix == pytest.approx(matrix, rel=1e-9, abs=1e-11 * matrix.max())


@settings(deadline=None)
@given(transversely_isotropic(), st.floats(-7.0, 7.0))
def test_a_transversely_isotropic_material_is_the_same_at_every_angle(material, theta):
    matrix = material.hooke().matrix
    turned = material.hooke().cylindrical_to_cartesian(theta).matrix
    assert turned == pytest.approx(matrix, rel=1e-9, abs=1e-11 * np.abs(matrix).max())


def test_a_quarter_turn_exchanges_r_and_theta():
    turned = WOOD.cylindrical_to_cartesian(np.pi / 2.0).matrix
    exchanged = WOOD.matrix[np.ix_([1, 0, 2, 4, 3, 5], [1, 0, 2, 4, 3, 5])]
    assert turned == pytest.approx(exchanged, abs=1e-3)


def test_the_modulus_along_x_at_45_degrees():
    # E_x⁻¹ = ¼ (1/E_r + 1/E_t + 1/G_rt − 2 ν_rt/E_r), the textbook's off-axis modulus of a ply
    off_axis = 0.25 * (1.0 / 1.0e9 + 1.0 / 0.5e9 + 1.0 / 0.05e9 - 2.0 * 0.4 / 1.0e9)
    assert WOOD.cylindrical_to_cartesian(np.pi / 4.0).compliance[0, 0] == pytest.approx(off_axis, rel=1e-12)


def test_a_matrix_that_is_no_rotation_is_refused():
    with pytest.raises(MaterialError, match="orthogonal"):
        WOOD.rotated(2.0 * cylinder_axes(0.3))
    with pytest.raises(MaterialError, match="orthogonal"):
        WOOD.rotated(np.eye(2))
