import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from material_strategies import isotropic

from statorhom.errors import MaterialError
from statorhom.materials.homogenization.laminate import Ply, homogenize_laminate
from statorhom.materials.homogenization.layers import Contact, Layer, homogenize_layers
from statorhom.materials.isotropic import Isotropic

STEEL = Isotropic(205e9, 0.29)
LAYERS = st.lists(
    st.builds(Layer, material=isotropic(lowest_nu=0.0), thickness_m=st.floats(1e-6, 1e-3)),
    min_size=1,
    max_size=4,
)


def sheet_and_coating(coating):
    return [Layer(STEEL, 0.5e-3), Layer(coating, 5e-6)]


@pytest.mark.parametrize(
    ("coating", "in_gpa"),
    [(Isotropic(3e9, 0.35), (203.0, 144.6, 46.8)), (Isotropic(0.1e9, 0.45), (203.0, 32.3, 3.34))],
)
def test_sheets_with_a_coating_give_the_published_figures(coating, in_gpa):
    stack = homogenize_layers(sheet_and_coating(coating))
    found = np.array([stack.E_p_pa, stack.E_z_pa, stack.G_rz_pa]) / 1e9
    assert found == pytest.approx(in_gpa, rel=2e-3)


@settings(deadline=None)
@given(isotropic(), st.lists(st.floats(1e-6, 1e-3), min_size=1, max_size=3))
def test_layers_of_one_material_are_that_material(material, thicknesses):
    stack = homogenize_layers([Layer(material, t) for t in thicknesses])
    expected = material.hooke().matrix
    assert stack.hooke().matrix == pytest.approx(expected, rel=1e-7, abs=1e-8 * expected.max())


@settings(deadline=None)
@given(LAYERS)
def test_the_stiffness_lies_between_reuss_and_voigt(layers):
    share = np.array([layer.thickness_m for layer in layers])
    share /= share.sum()
    hookes = [layer.material.hooke() for layer in layers]
    found = homogenize_layers(layers).hooke()
    voigt = sum(s * hooke.matrix for s, hooke in zip(share, hookes, strict=True))
    reuss = sum(s * hooke.compliance for s, hooke in zip(share, hookes, strict=True))
    assert np.linalg.eigvalsh(voigt - found.matrix).min() >= -1e-7 * np.abs(voigt).max()
    assert np.linalg.eigvalsh(reuss - found.compliance).min() >= -1e-7 * np.abs(reuss).max()


@settings(deadline=None)
@given(LAYERS)
def test_backus_is_the_laminate_of_isotropic_plies(layers):
    plies = [Ply(layer.material.hooke(), layer.thickness_m) for layer in layers]
    general = homogenize_laminate(plies).matrix
    assert homogenize_layers(layers).hooke().matrix == pytest.approx(
        general, rel=1e-6, abs=1e-8 * np.abs(general).max()
    )


def test_a_contact_equals_a_thin_soft_layer():
    # a layer without lateral contraction, thin and soft: normal k = 2μ/h, tangential k = μ/h
    height, shear = 1e-10, 1e3
    with_layer = homogenize_layers([Layer(STEEL, 0.5e-3), Layer(Isotropic(2.0 * shear, 0.0), height)])
    contact = Contact(normal_n_per_m3=2.0 * shear / height, tangential_n_per_m3=shear / height)
    with_contact = homogenize_layers([Layer(STEEL, 0.5e-3)], contact)
    assert with_contact.hooke().matrix == pytest.approx(with_layer.hooke().matrix, rel=1e-5, abs=1.0)
    assert with_contact.E_z_pa < 0.1 * STEEL.E_pa


def test_a_sliding_contact_softens_shear_alone():
    sliding = Contact(normal_n_per_m3=np.inf, tangential_n_per_m3=1e13)
    stack = homogenize_layers([Layer(STEEL, 0.5e-3)], sliding)
    assert stack.E_z_pa == pytest.approx(STEEL.E_pa)
    assert 1.0 / stack.G_rz_pa == pytest.approx(1.0 / STEEL.shear_modulus_pa + 1.0 / (0.5e-3 * 1e13))


def test_what_is_no_layer_is_refused():
    with pytest.raises(MaterialError, match="at least one"):
        homogenize_layers([])
    with pytest.raises(MaterialError, match="thickness_m must be positive"):
        Layer(STEEL, 0.0)
    with pytest.raises(MaterialError, match="tangential_n_per_m3 must be positive"):
        Contact(1e12, -1.0)
    with pytest.raises(MaterialError, match="normal_n_per_m3 must be positive"):
        Contact(float("nan"), 1e12)
