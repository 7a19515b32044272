import pytest

from statorhom.errors import MaterialError
from statorhom.materials.analytic import analytic_lamination, analytic_winding


def test_bonded_sheets():
    stack = analytic_lamination(0.5e-3, 5e-6)
    assert stack.E_p_pa == pytest.approx(203.0e9, rel=1e-3)
    assert stack.E_z_pa == pytest.approx(144.6e9, rel=1e-3)
    assert stack.G_rz_pa == pytest.approx(46.8e9, rel=1e-3)


def test_the_fill_follows_from_the_weighings():
    # bare wires: 3048 kg/m³ of copper are 34 %, 119 kg/m³ of resin 10 % of the volume
    winding = analytic_winding(0.34 * 8960.0, 0.34 * 8960.0 + 0.10 * 1200.0, 0.25e-3, 0.25e-3)
    assert winding.E_z_pa == pytest.approx(0.34 * 120e9 + 0.10 * 3e9, rel=5e-3)
    assert winding.E_p_pa < 1e9


def test_enamel_takes_room_from_the_copper():
    bare = analytic_winding(3000.0, 3120.0, 0.25e-3, 0.25e-3)
    insulated = analytic_winding(3000.0, 3120.0, 0.25e-3, 0.275e-3)
    copper = 3000.0 / (8960.0 + 0.21 * 1400.0)
    assert insulated.E_z_pa < bare.E_z_pa
    assert insulated.E_z_pa == pytest.approx(120e9 * copper + 3e9 * (0.21 * copper + 0.1), rel=5e-3)


@pytest.mark.parametrize(
    ("arguments", "reason"),
    [
        ((3000.0, 3000.0, 0.25e-3, 0.275e-3), "needs both conductor and resin"),
        ((8000.0, 8900.0, 0.25e-3, 0.275e-3), "exceed 1"),
        ((3000.0, 2900.0, 0.25e-3, 0.275e-3), "must lie in 0 … 1"),
        ((3000.0, 3120.0, 0.25e-3, 0.2e-3), "at most insulated_radius_mm, is 0.25 against 0.2$"),
        ((3000.0, 3120.0, 0.0, 0.2e-3), "must be positive"),
    ],
)
def test_impossible_windings_are_refused(arguments, reason):
    with pytest.raises(MaterialError, match=reason):
        analytic_winding(*arguments)


def test_impossible_sheets_are_refused():
    with pytest.raises(MaterialError, match="thickness_m must be positive"):
        analytic_lamination(0.5e-3, 0.0)
