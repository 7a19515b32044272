import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from material_strategies import any_hooke

from statorhom.errors import MaterialError
from statorhom.materials.homogenization.laminate import Ply, homogenize_laminate, plate_stiffness
from statorhom.materials.isotropic import Isotropic
from statorhom.materials.orthotropic import Orthotropic

CARBON = Orthotropic(140e9, 9e9, 9e9, 0.3, 0.3, 0.45, 5e9, 5e9, 3e9).hooke()
ANGLES = st.lists(st.floats(-90.0, 90.0), min_size=1, max_size=4)


def plies(angles):
    return [Ply(CARBON, 0.2e-3, angle) for angle in angles]


@settings(deadline=None)
@given(ANGLES)
def test_a_symmetric_laminate_does_not_bend_when_it_is_pulled(angles):
    plate = plate_stiffness(plies([*angles, *reversed(angles)]))
    assert np.abs(plate.B).max() < 1e-9 * plate.A.max() * 0.2e-3


def test_an_unsymmetric_laminate_bends_when_it_is_pulled():
    plate = plate_stiffness(plies([0.0, 90.0]))
    # B11 = h² (Q22 − Q11)/8 for two crossed plies, h = 0.4 mm in all, the stiff one below
    q = np.linalg.inv(CARBON.compliance[np.ix_([0, 1, 5], [0, 1, 5])])
    assert plate.B[0, 0] == pytest.approx((q[1, 1] - q[0, 0]) * (0.4e-3) ** 2 / 8.0)
    assert plate.B[1, 1] == pytest.approx(-plate.B[0, 0])


def test_an_isotropic_plate_has_the_textbook_bending_stiffness():
    thickness, material = 4e-3, Isotropic(70e9, 0.33)
    plate = plate_stiffness([Ply(material.hooke(), thickness / 4.0, angle) for angle in (0, 30, 60, 90)])
    assert plate.D[0, 0] == pytest.approx(70e9 * thickness**3 / (12.0 * (1.0 - 0.33**2)))
    assert plate.A[0, 1] == pytest.approx(0.33 * plate.A[0, 0])
    assert plate.A[2, 2] == pytest.approx(material.shear_modulus_pa * thickness)


def test_three_plies_sixty_degrees_apart_are_isotropic_in_the_plane():
    a = plate_stiffness(plies([0.0, 60.0, -60.0])).A
    assert a[0, 0] == pytest.approx(a[1, 1])
    assert a[2, 2] == pytest.approx((a[0, 0] - a[0, 1]) / 2.0)
    assert a[:2, 2] == pytest.approx(0.0, abs=1e-9 * a[0, 0])


@settings(deadline=None)
@given(any_hooke(), st.floats(-90.0, 90.0))
def test_plies_of_one_material_are_that_material(hooke, angle):
    solid = homogenize_laminate([Ply(hooke, 1e-3, angle), Ply(hooke, 2e-3, angle)])
    expected = hooke.cylindrical_to_cartesian(np.radians(angle)).matrix
    assert solid.matrix == pytest.approx(expected, rel=1e-7, abs=1e-8 * np.abs(expected).max())


@settings(deadline=None)
@given(ANGLES)
def test_the_solid_and_the_plate_are_pulled_alike(angles):
    stack = plies([*angles, *reversed(angles)])
    solid = homogenize_laminate(stack)
    in_plane = np.ix_([0, 1, 5], [0, 1, 5])
    # no stress through the thickness in either: the condensed solid times its height is A
    height = 0.2e-3 * len(stack)
    a = plate_stiffness(stack).A
    assert np.linalg.inv(solid.compliance[in_plane]) * height == pytest.approx(
        a, rel=1e-9, abs=1e-9 * a.max()
    )


@settings(deadline=None)
@given(ANGLES)
def test_the_solid_lies_between_reuss_and_voigt(angles):
    stack = plies(angles)
    solid = homogenize_laminate(stack)
    voigt = np.mean([ply.turned().matrix for ply in stack], axis=0)
    reuss = np.mean([ply.turned().compliance for ply in stack], axis=0)
    assert np.linalg.eigvalsh(voigt - solid.matrix).min() >= -1e-9 * voigt.max()
    assert np.linalg.eigvalsh(reuss - solid.compliance).min() >= -1e-9 * reuss.max()


def test_what_is_no_laminate_is_refused():
    with pytest.raises(MaterialError, match="at least one ply"):
        plate_stiffness([])
    with pytest.raises(MaterialError, match="at least one ply"):
        homogenize_laminate([])
    with pytest.raises(MaterialError, match="thickness_m must be positive"):
        Ply(CARBON, -1e-3)


def test_its_matrices_cannot_be_changed():
    with pytest.raises(ValueError, match="read-only"):
        plate_stiffness(plies([0.0])).A[0, 0] = 1.0
