import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from statorhom.errors import MaterialError
from statorhom.materials.homogenization.fibres import homogenize_fibres
from statorhom.materials.homogenization.transverse_shear import self_consistent
from statorhom.materials.homogenization.wires import Fill, homogenize_wires
from statorhom.materials.isotropic import Isotropic

COPPER, ENAMEL, RESIN = Isotropic(120e9, 0.34), Isotropic(4e9, 0.38), Isotropic(3e9, 0.35)


def test_bare_wires_without_void_are_fibres_in_resin():
    winding = homogenize_wires(COPPER, ENAMEL, RESIN, Fill(conductor=0.4, insulation=0.0, resin=0.6))
    assert winding.hooke().matrix == pytest.approx(
        homogenize_fibres(COPPER, RESIN, 0.4).hooke().matrix, rel=1e-9, abs=1.0
    )


def test_insulation_of_the_resins_material_makes_the_composite_cylinder():
    # E_L, k and G_L of composite cylinders do not depend on where a shell of matrix is drawn
    coated = homogenize_wires(COPPER, RESIN, RESIN, Fill(conductor=0.4, insulation=0.1, resin=0.5))
    plain = homogenize_fibres(COPPER, RESIN, 0.4)
    assert coated.E_z_pa == pytest.approx(plain.E_z_pa, rel=1e-9)
    assert coated.G_rz_pa == pytest.approx(plain.G_rz_pa, rel=1e-9)


@settings(deadline=None)
@given(st.floats(0.05, 0.5), st.floats(0.0, 0.1), st.floats(0.02, 0.4), st.floats(0.5, 0.95))
def test_taking_resin_away_softens(conductor, insulation, resin, left):
    full = homogenize_wires(COPPER, ENAMEL, RESIN, Fill(conductor, insulation, resin))
    less = homogenize_wires(COPPER, ENAMEL, RESIN, Fill(conductor, insulation, left * resin))
    assert less.E_p_pa < full.E_p_pa
    assert less.E_z_pa < full.E_z_pa
    assert less.G_rz_pa < full.G_rz_pa


def test_along_the_wires_the_copper_carries():
    winding = homogenize_wires(COPPER, ENAMEL, RESIN, Fill(0.34, 0.06, 0.10), self_consistent)
    assert winding.E_z_pa == pytest.approx(0.34 * 120e9 + 0.06 * 4e9 + 0.10 * 3e9, rel=1e-2)
    assert winding.E_p_pa < 0.05 * winding.E_z_pa


def test_the_shares_are_counted():
    fill = Fill(conductor=0.34, insulation=0.06, resin=0.10)
    assert fill.wires == pytest.approx(0.40)
    assert fill.void == pytest.approx(0.50)


@pytest.mark.parametrize(
    ("shares", "reason"),
    [
        ((0.6, 0.2, 0.3), r"conductor \+ insulation \+ resin = 0.6 \+ 0.2 \+ 0.3 exceed 1"),
        ((0.5, -0.1, 0.3), "must lie in 0 … 1"),
        ((float("nan"), 0.1, 0.3), "must lie in 0 … 1"),
        ((0.4, 0.1, 0.0), "needs both conductor and resin"),
        ((0.0, 0.1, 0.2), "needs both conductor and resin"),
    ],
)
def test_impossible_shares_are_refused(shares, reason):
    with pytest.raises(MaterialError, match=reason):
        Fill(*shares)
