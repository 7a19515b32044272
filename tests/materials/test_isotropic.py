import numpy as np
import pytest
from hypothesis import given, settings
from material_strategies import isotropic

from statorhom.errors import MaterialError
from statorhom.materials.isotropic import Isotropic
from statorhom.materials.transversely_isotropic import TransverselyIsotropic


@settings(deadline=None)
@given(isotropic())
def test_round_trip(material):
    back = Isotropic.from_hooke(material.hooke())
    assert back.E_pa == pytest.approx(material.E_pa, rel=1e-9)
    assert back.nu == pytest.approx(material.nu, abs=1e-9)


@settings(deadline=None)
@given(isotropic())
def test_accepted_constants_have_a_positive_definite_matrix(material):
    material.hooke().check_positive_definite()


def test_uniaxial_stress_gives_the_definition_of_the_constants():
    strain = Isotropic(210e9, 0.3).hooke().compliance @ [210e6, 0, 0, 0, 0, 0]
    assert strain == pytest.approx([1e-3, -0.3e-3, -0.3e-3, 0, 0, 0], abs=1e-15)


def test_lame_constants_fill_the_matrix():
    material = Isotropic(200e9, 0.25)
    assert material.shear_modulus_pa == pytest.approx(80e9)
    assert material.lame_pa == pytest.approx(80e9)
    assert material.hooke().matrix[3:, 3:] == pytest.approx(80e9 * np.eye(3))


@pytest.mark.parametrize(
    ("constants", "condition"),
    [
        ((0.0, 0.3), "E_pa must be positive"),
        ((1e9, -1.0), "nu must stay above -1"),
        ((1e9, 0.5), "nu must stay below 0.5"),
        ((1e9, float("nan")), "nu must be a finite number"),
        ((float("inf"), 0.3), "E_pa must be a finite number"),
    ],
)
def test_the_violated_condition_is_named(constants, condition):
    with pytest.raises(MaterialError, match=f"^isotropic material: {condition}"):
        Isotropic(*constants)


def test_an_anisotropic_matrix_has_no_isotropic_constants():
    with pytest.raises(MaterialError, match="is not isotropic, C33"):
        Isotropic.from_hooke(TransverselyIsotropic(180e9, 70e9, 0.28, 0.26, 30e9).hooke())
