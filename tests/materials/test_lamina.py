"""Plies in plane stress against printed textbook figures, and what no ply can be."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from statorhom.errors import MaterialError
from statorhom.materials.homogenization.laminate import Ply, homogenize_laminate, plate_stiffness
from statorhom.materials.homogenization.layers import Layer, homogenize_layers
from statorhom.materials.isotropic import Isotropic
from statorhom.materials.lamina import Lamina, stress_turn

# T300/5208 graphite/epoxy: S. W. Tsai and H. T. Hahn, Introduction to Composite Materials, 1980, table 1.7;
# the worked examples are those of A. K. Kaw, Mechanics of Composite Materials, 2nd ed. 2006
GRAPHITE = Lamina(181e9, 10.3e9, 0.28, 7.17e9)
SOLID = GRAPHITE.solid(10.3e9, 0.28, 0.5, 7.17e9, 3.43e9).hooke()
ANGLES = st.floats(-90.0, 90.0)


@st.composite
def laminas(draw):
    along, across, shear = (10.0 ** draw(st.floats(8.0, 12.0)) for _ in range(3))
    return Lamina(along, across, draw(st.floats(-0.95, 0.95)) * math.sqrt(along / across), shear)


def test_the_reduced_stiffness_is_the_printed_one():
    # Kaw, example 2.6
    assert GRAPHITE.reduced / 1e9 == pytest.approx(
        np.array([[181.8, 2.897, 0.0], [2.897, 10.35, 0.0], [0.0, 0.0, 7.17]]), rel=5e-4
    )
    assert GRAPHITE.nu_21 == pytest.approx(0.01593, rel=5e-4)


def test_a_turned_ply_is_the_printed_one():
    # Kaw, example 2.7: 60 degrees
    printed = np.array([[23.65, 32.46, 20.05], [32.46, 109.4, 54.19], [20.05, 54.19, 36.74]])
    assert GRAPHITE.turned(60.0) / 1e9 == pytest.approx(printed, rel=5e-4)


def test_the_stiffness_of_an_unsymmetric_laminate_is_the_printed_one():
    # Kaw, example 4.2: [0/30/-45], plies of 5 mm
    plate = plate_stiffness([Ply(SOLID, 5e-3, angle) for angle in (0.0, 30.0, -45.0)])
    A = [[1.739e9, 3.884e8, 5.663e7], [3.884e8, 4.533e8, -1.141e8], [5.663e7, -1.141e8, 4.525e8]]
    B = [[-3.129e6, 9.855e5, -1.072e6], [9.855e5, 1.158e6, -1.072e6], [-1.072e6, -1.072e6, 9.855e5]]
    D = [[3.343e4, 6.461e3, -5.240e3], [6.461e3, 9.320e3, -5.596e3], [-5.240e3, -5.596e3, 7.663e3]]
    for found, printed in ((plate.A, A), (plate.B, B), (plate.D, D)):
        assert found == pytest.approx(np.array(printed), rel=5e-4)
    assert plate.K[:3, 3:] == pytest.approx(plate.B) and plate.K[3:, :3] == pytest.approx(plate.B)


def test_the_quasi_isotropic_laminate_has_the_printed_moduli():
    # Tsai and Hahn, table 4.5: 69.7 GPa, 0.30, 26.9 GPa
    stack = (0.0, 45.0, -45.0, 90.0, 90.0, -45.0, 45.0, 0.0)
    plate = plate_stiffness([Ply(SOLID, 0.125e-3, angle) for angle in stack])
    E_1, E_2, G, nu = plate.in_plane(1e-3)
    assert pytest.approx((69.7, 69.7, 26.9), abs=0.05) == (E_1 / 1e9, E_2 / 1e9, G / 1e9)
    assert nu == pytest.approx(0.30, abs=5e-3)
    assert pytest.approx(E_1 / (2.0 * (1.0 + nu))) == G


def test_only_a_symmetric_laminate_has_moduli_in_its_plane():
    with pytest.raises(MaterialError, match="bends when it is pulled"):
        plate_stiffness([Ply(SOLID, 1e-3, 0.0), Ply(SOLID, 1e-3, 90.0)]).in_plane(2e-3)


def test_the_seed_misprints_its_turned_ply():
    """Its equation (6), T Q T⁻ᵀ with the T of (7), is not even symmetric; T⁻¹ Q T⁻ᵀ is the ply."""
    T = stress_turn(math.radians(30.0))
    printed = T @ GRAPHITE.reduced @ np.linalg.inv(T).T
    assert abs(printed[0, 2] - printed[2, 0]) > 1e9
    assert np.linalg.inv(T) @ GRAPHITE.reduced @ np.linalg.inv(T).T == pytest.approx(
        GRAPHITE.turned(30.0), rel=1e-9
    )


@given(laminas(), ANGLES)
def test_turning_keeps_the_invariants(lamina, angle):
    # Tsai and Pagano: Q11 + Q22 + 2 Q12 and Q66 − Q12 do not depend on the axes
    Q, turned = lamina.reduced, lamina.turned(angle)
    scale = np.abs(Q).max()
    for f in (lambda m: m[0, 0] + m[1, 1] + 2 * m[0, 1], lambda m: m[2, 2] - m[0, 1]):
        assert f(turned) == pytest.approx(f(Q), rel=1e-9, abs=1e-9 * scale)
    assert np.linalg.eigvalsh(turned).min() > -1e-9 * scale


@given(laminas(), ANGLES)
def test_a_ply_and_its_solid_are_pulled_alike(lamina, angle):
    """The plane-stress stiffness comes out of the solid whatever its constants through the thickness are."""
    solid = lamina.solid(min(lamina.E_1_pa, lamina.E_2_pa), 0.0, 0.0, lamina.G_12_pa, lamina.G_12_pa)
    plate = plate_stiffness([Ply(solid.hooke(), 2e-3, angle)])
    scale = np.abs(lamina.reduced).max()
    assert pytest.approx(lamina.turned(angle), rel=1e-6, abs=1e-7 * scale) == plate.A / 2e-3


@given(st.floats(0.1, 0.9))
def test_isotropic_plies_make_the_layered_solid(share):
    """Pagano's solid of isotropic plies is Backus' of layers."""
    stiff, soft = Isotropic(205e9, 0.29), Isotropic(3e9, 0.35)
    plies = [Ply(stiff.hooke(), share * 1e-3), Ply(soft.hooke(), (1 - share) * 1e-3)]
    layers = [Layer(stiff, share * 1e-3), Layer(soft, (1 - share) * 1e-3)]
    expected = homogenize_layers(layers).hooke().matrix
    assert homogenize_laminate(plies).matrix == pytest.approx(expected, rel=1e-9, abs=1.0)


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: Ply(SOLID, 1e-3, 135.0), r"angle_deg must lie in -90 … 90, is 135"),
        (lambda: Ply(SOLID, 1e-3, math.nan), r"angle_deg must lie in -90 … 90, is nan"),
        (lambda: GRAPHITE.turned(-100.0), r"angle_deg must lie in -90 … 90, is -100"),
        (lambda: Ply(SOLID, 0.0), "thickness_m must be positive and finite, is 0"),
        (lambda: Lamina(50e9, 50e9, 1.2, 4e9), r"\|nu_12\| must stay below sqrt\(E_1/E_2\) = 1, is 1.2"),
        (lambda: Lamina(10e9, 160e9, 0.3, 4e9), r"must stay below sqrt\(E_1/E_2\) = 0.25"),
        (lambda: Lamina.woven(50e9, 0.04, 0.0), "G_12_pa must be positive, is 0"),
        (lambda: Lamina.woven(math.inf, 0.04, 4e9), "E_1_pa must be a finite number"),
    ],
)
def test_what_is_no_ply_is_refused_in_one_line(make, said):
    with pytest.raises(MaterialError, match=said) as caught:
        make()
    assert "\n" not in str(caught.value)
