from dataclasses import astuple

import pytest
from hypothesis import given, settings
from material_strategies import isotropic, transversely_isotropic

from statorhom.errors import MaterialError
from statorhom.materials.homogenization.hill_moduli import VOID, HillModuli


@settings(deadline=None)
@given(isotropic())
def test_the_moduli_of_an_isotropic_phase(material):
    moduli = HillModuli.of(material)
    bulk = material.E_pa / (2.0 * (1.0 + material.nu) * (1.0 - 2.0 * material.nu))
    assert moduli.k_pa == pytest.approx(bulk, rel=1e-9)
    assert moduli.E_L_pa == pytest.approx(material.E_pa, rel=1e-9)
    assert moduli.nu_l == pytest.approx(material.nu, abs=1e-9)
    assert moduli.G_T_pa == pytest.approx(material.shear_modulus_pa)
    assert moduli.G_L_pa == pytest.approx(material.shear_modulus_pa)


@settings(deadline=None)
@given(transversely_isotropic())
def test_round_trip(material):
    back = HillModuli.of(material).engineering()
    ratio = (material.E_p_pa / material.E_z_pa) ** 0.5
    assert (back.E_p_pa, back.E_z_pa) == pytest.approx((material.E_p_pa, material.E_z_pa), rel=1e-8)
    assert (back.nu_p, back.nu_pz / ratio) == pytest.approx((material.nu_p, material.nu_pz / ratio), abs=1e-8)
    assert back.G_rz_pa == material.G_rz_pa


def test_a_void_has_no_engineering_constants():
    assert set(astuple(VOID)) == {0.0}
    with pytest.raises(MaterialError, match="a modulus vanishes"):
        VOID.engineering()
