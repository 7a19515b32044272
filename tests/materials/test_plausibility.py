import math

import pytest

from statorhom.materials.density import RegionDensity
from statorhom.materials.plausibility import density_warning, plausible_range


def density(region, value, sd=5.0):
    return RegionDensity("step", region, value * 1e-3, 1e-3, value, sd)


def test_the_ranges():
    assert plausible_range("lamination") == pytest.approx((7000.0, 7870.0))
    assert plausible_range("winding") == (0.0, 8960.0)
    assert plausible_range("frame") == (1700.0, 8000.0)
    assert plausible_range("machine") == (0.0, math.inf)


@pytest.mark.parametrize(
    ("region", "value"),
    [
        ("lamination", 7810.5),
        ("lamination", 7000.0),
        ("winding", 3166.4),
        ("frame", 2700.0),
        ("machine", 20000.0),
    ],
)
def test_plausible_densities_pass_in_silence(region, value):
    assert density_warning(density(region, value)) is None


@pytest.mark.parametrize(
    ("region", "value"),
    [
        ("lamination", 6500.0),
        ("lamination", 8500.0),
        ("winding", 9100.0),
        ("frame", 1500.0),
        ("frame", 9000.0),
    ],
)
def test_impossible_densities_are_doubted(region, value):
    warning = density_warning(density(region, value))
    assert (warning.region, warning.density_kg_m3) == (region, value)
    assert (warning.low_kg_m3, warning.high_kg_m3) == plausible_range(region)
    assert not warning.low_kg_m3 <= warning.density_kg_m3 <= warning.high_kg_m3


def test_the_warning_is_one_line_with_the_numbers_and_the_keys():
    message = density_warning(density("lamination", 9200.0)).message
    assert "\n" not in message
    for part in ("'step'", "lamination", "9200", "7000 … 7870", "mass_kg", "geometry"):
        assert part in message


def test_an_uncertain_weight_is_given_the_benefit_of_the_doubt():
    assert density_warning(density("lamination", 7900.0, sd=20.0)) is None
    assert density_warning(density("lamination", 7900.0, sd=10.0)) is not None
