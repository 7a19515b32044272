from dataclasses import astuple, replace

import numpy as np
import pytest
from hypothesis import given, settings
from material_strategies import orthotropic, transversely_isotropic

from statorhom.errors import MaterialError
from statorhom.materials.hooke import Hooke
from statorhom.materials.orthotropic import Orthotropic
from statorhom.materials.rotation import cylinder_axes, rotate

WOOD = Orthotropic(
    E_r_pa=1.0e9,
    E_t_pa=0.5e9,
    E_z_pa=12.0e9,
    nu_rt=0.4,
    nu_rz=0.03,
    nu_tz=0.02,
    G_rt_pa=0.05e9,
    G_rz_pa=0.7e9,
    G_tz_pa=0.8e9,
)


@settings(deadline=None)
@given(orthotropic())
def test_round_trip(material):
    back = Orthotropic.from_hooke(material.hooke())
    moduli, again = np.array(astuple(material)), np.array(astuple(back))
    assert again[[0, 1, 2, 6, 7, 8]] == pytest.approx(moduli[[0, 1, 2, 6, 7, 8]], rel=1e-8)
    largest = np.sqrt(moduli[[0, 0, 1]] / moduli[[1, 2, 2]])
    assert again[3:6] / largest == pytest.approx(moduli[3:6] / largest, abs=1e-8)


@settings(deadline=None)
@given(orthotropic())
def test_accepted_constants_have_a_positive_definite_matrix(material):
    matrix = material.hooke().matrix
    scale = 1.0 / np.sqrt(np.diag(matrix))
    assert np.linalg.eigvalsh(matrix * np.outer(scale, scale)).min() > 0.0


def test_stress_along_each_axis_gives_the_defined_ratios():
    s = WOOD.hooke().compliance
    assert s[1, 0] / s[0, 0] == pytest.approx(-0.4)
    assert s[2, 0] / s[0, 0] == pytest.approx(-0.03)
    assert s[2, 1] / s[1, 1] == pytest.approx(-0.02)
    assert 1.0 / np.diag(s) == pytest.approx([1.0e9, 0.5e9, 12.0e9, 0.8e9, 0.7e9, 0.05e9])


@pytest.mark.parametrize(
    ("changed", "condition"),
    [
        *[({name: 0.0}, f"{name} must be positive") for name in ("E_r_pa", "E_t_pa", "E_z_pa")],
        *[({name: -1.0}, f"{name} must be positive") for name in ("G_rt_pa", "G_rz_pa", "G_tz_pa")],
        ({"nu_rt": -1.42}, r"\|nu_rt\| must stay below sqrt\(E_r/E_t\) = 1.41421, is 1.42$"),
        ({"nu_rz": 0.3}, r"\|nu_rz\| must stay below sqrt\(E_r/E_z\) = 0.288675"),
        ({"nu_tz": 0.21}, r"\|nu_tz\| must stay below sqrt\(E_t/E_z\) = 0.204124"),
        ({"nu_rt": 1.0, "nu_rz": 0.2, "nu_tz": 0.15}, "1 - nu_rt nu_tr - .* must stay positive, is -"),
        ({"E_z_pa": float("inf")}, "E_z_pa must be a finite number"),
    ],
)
def test_the_violated_condition_is_named(changed, condition):
    with pytest.raises(MaterialError, match=f"^orthotropic material: {condition}"):
        replace(WOOD, **changed)


def test_the_determinant_decides_on_both_sides_of_its_zero():
    # E equal and all ratios ν: 1 − 3ν² − 2ν³ is zero at ν = 1/2
    def equal(nu):
        return Orthotropic(1.0, 1.0, 1.0, nu, nu, nu, 1.0, 1.0, 1.0)

    equal(0.4999)
    with pytest.raises(MaterialError, match="make the Poisson's ratios smaller"):
        equal(0.5001)


@settings(deadline=None)
@given(transversely_isotropic())
def test_a_transversely_isotropic_material_is_a_special_case(material):
    general = Orthotropic.from_hooke(material.hooke())
    assert general.E_r_pa == pytest.approx(general.E_t_pa, rel=1e-9)
    assert general.G_rt_pa == pytest.approx(material.G_p_pa, rel=1e-9)
    assert general.nu_rz == pytest.approx(general.nu_tz, rel=1e-6, abs=1e-12)


def test_turned_axes_are_not_those_of_orthotropy():
    with pytest.raises(MaterialError, match="is not orthotropic"):
        Orthotropic.from_hooke(Hooke(rotate(WOOD.hooke().matrix, cylinder_axes(0.5))))
