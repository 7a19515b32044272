import pytest

from statorhom.errors import MaterialError
from statorhom.materials.typical_ranges import typical_region


@pytest.mark.parametrize(
    ("region", "role", "low", "high"),
    # physics of stators in general: what any prior has to contain
    [
        ("lamination", "E_p", 150.0, 205.0),
        ("lamination", "E_z", 20.0, 150.0),
        ("lamination", "E_z", 0.5, 20.0),
        ("lamination", "G_rz", 10.0, 45.0),
        ("lamination", "G_rz", 0.3, 10.0),
        ("lamination", "nu_p", 0.2, 0.4),
        ("winding", "E_p", 0.1, 10.0),
        ("winding", "E_z", 1.0, 60.0),
        ("winding", "nu_p", 0.2, 0.4),
        ("frame", "E", 70.0, 205.0),
    ],
)
@pytest.mark.parametrize("stage_kind", ["stack", "wound", "impregnated", "framed", "machine"])
def test_the_ranges_contain_what_is_usual(region, role, low, high, stage_kind):
    found = typical_region(region, stage_kind).ranges[role]
    assert found[0] <= low
    assert found[1] >= high


def test_a_dry_winding_may_be_softer():
    dry, potted = typical_region("winding", "wound"), typical_region("winding", "impregnated")
    assert dry.ranges["E_p"][0] < potted.ranges["E_p"][0]
    assert dry.ranges["G_rz"][0] < potted.ranges["G_rz"][0]


def test_limits_reach_beyond_the_range_but_not_beyond_the_constituents():
    winding = typical_region("winding", "impregnated")
    low, high = winding.limits("E_p")
    assert low < 0.1
    assert high == 130.0
    assert typical_region("lamination", "stack").limits("E_p") == pytest.approx((120.0, 240.0), rel=0.01)


def test_an_unknown_region_is_refused():
    with pytest.raises(
        MaterialError, match="'rotor': use one of lamination, winding, overhang, frame, machine"
    ):
        typical_region("rotor", "stack")
