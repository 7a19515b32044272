from dataclasses import astuple, replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from material_strategies import MODULI, isotropic, transversely_isotropic

from statorhom.errors import MaterialError
from statorhom.materials.hooke import Hooke
from statorhom.materials.orthotropic import Orthotropic
from statorhom.materials.transversely_isotropic import TransverselyIsotropic

STACK = TransverselyIsotropic(E_p_pa=180e9, E_z_pa=100e9, nu_p=0.28, nu_pz=0.25, G_rz_pa=25e9)


def compliance(material):
    """S by its definition, with no regard to whether it is positive definite."""
    s = np.diag(1.0 / np.array([material["E_p"]] * 2 + [material["E_z"]] + [material["G"]] * 2 + [1.0]))
    s[0, 1] = s[1, 0] = -material["nu_p"] / material["E_p"]
    s[:2, 2] = s[2, :2] = -material["nu_pz"] / material["E_p"]
    s[5, 5] = 2.0 * (1.0 + material["nu_p"]) / material["E_p"]
    return s


@settings(deadline=None)
@given(transversely_isotropic())
def test_round_trip(material):
    back = TransverselyIsotropic.from_hooke(material.hooke())
    ratio = np.sqrt(material.E_p_pa / material.E_z_pa)
    assert (back.E_p_pa, back.E_z_pa, back.G_rz_pa) == pytest.approx(
        (material.E_p_pa, material.E_z_pa, material.G_rz_pa), rel=1e-8
    )
    assert back.nu_p == pytest.approx(material.nu_p, abs=1e-8)
    assert back.nu_pz / ratio == pytest.approx(material.nu_pz / ratio, abs=1e-8)


def test_the_matrix_is_the_inverse_of_the_defined_compliance():
    s = compliance({"E_p": 180e9, "E_z": 100e9, "nu_p": 0.28, "nu_pz": 0.25, "G": 25e9})
    assert STACK.hooke().matrix @ s == pytest.approx(np.eye(6), abs=1e-12)
    assert STACK.hooke().matrix[3, 3] == 25e9
    assert STACK.hooke().matrix[5, 5] == pytest.approx(STACK.G_p_pa)


@settings(deadline=None, max_examples=300)
@given(MODULI, MODULI, st.floats(-1.5, 1.5), st.floats(-2.0, 2.0))
def test_constants_are_accepted_exactly_where_the_energy_is_positive(across, along, nu_p, nu_pz):
    s = compliance({"E_p": 1.0, "E_z": along / across, "nu_p": nu_p, "nu_pz": nu_pz, "G": 1.0})
    scale = 1.0 / np.sqrt([1.0, 1.0, across / along, 1.0, 1.0, 1.0])
    smallest = np.linalg.eigvalsh(s * np.outer(scale, scale)).min()
    if abs(smallest) < 1e-9:
        return
    try:
        TransverselyIsotropic(across, along, nu_p, nu_pz, across)
        accepted = True
    except MaterialError:
        accepted = False
    assert accepted == (smallest > 0.0)


@pytest.mark.parametrize(
    ("changed", "condition"),
    [
        ({"E_p_pa": -1.0}, "E_p_pa must be positive"),
        ({"E_z_pa": 0.0}, "E_z_pa must be positive"),
        ({"G_rz_pa": -25e9}, "G_rz_pa must be positive"),
        ({"nu_p": -1.0}, "nu_p must stay above -1"),
        ({"nu_p": 1.0}, r"nu_p must stay below 1 - 2 nu_pz\^2 E_z/E_p = 0.930556, is 1$"),
        ({"nu_pz": 0.9}, r"nu_p must stay below 1 - 2 nu_pz\^2 E_z/E_p"),
        ({"nu_pz": float("nan")}, "nu_pz must be a finite number"),
    ],
)
def test_the_violated_condition_is_named(changed, condition):
    with pytest.raises(MaterialError, match=f"^transversely_isotropic material: {condition}"):
        replace(STACK, **changed)


@settings(deadline=None)
@given(isotropic())
def test_equal_constants_in_all_directions_are_an_isotropic_material(material):
    same = TransverselyIsotropic(
        material.E_pa, material.E_pa, material.nu, material.nu, material.shear_modulus_pa
    ).hooke()
    assert same.matrix == pytest.approx(material.hooke().matrix, rel=1e-9, abs=1e-9 * material.E_pa)


def test_the_axis_of_symmetry_must_be_z():
    lying = Hooke(STACK.hooke().rotated([[0, 0, 1], [0, 1, 0], [-1, 0, 0]]).matrix)
    with pytest.raises(MaterialError, match="is not transversely isotropic"):
        TransverselyIsotropic.from_hooke(lying)


def test_an_indefinite_matrix_has_no_constants():
    with pytest.raises(MaterialError, match="positive definite"):
        TransverselyIsotropic.from_hooke(Hooke(np.diag([1.0, 1.0, 1.0, 1.0, 1.0, -1.0])))


def test_a_small_deviation_in_the_soft_direction_is_seen():
    soft = Orthotropic(200e9, 200e9, 1e6, 0.3, 0.3, 0.3, 200e9 / 2.6, 1e6, 1.01e6)
    with pytest.raises(MaterialError, match="is not transversely isotropic, C55"):
        TransverselyIsotropic.from_hooke(soft.hooke())


def test_equality_is_by_value():
    assert TransverselyIsotropic(*astuple(STACK)) == STACK
