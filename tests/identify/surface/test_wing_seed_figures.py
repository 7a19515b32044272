"""Every figure of the wing seed that can be recomputed from another of its tables, and where one cannot be right."""

import numpy as np
import pytest

from statorhom.errors import IdentificationError
from statorhom.identify.results.material_tests import difference_percent
from statorhom.identify.surface.confidence_band import confidence_band

GVT = np.array([79.85, 114.94, 134.98, 157.75])
INITIAL = np.array([86.35, 125.58, 139.89, 162.03])
OPTIMIZED = np.array([80.99, 112.82, 135.21, 155.63])
FROM_TESTS = np.array([78.47, 111.93, 133.06, 156.86])
RANGES = np.array([[79.4, 80.02], [113.81, 115.08], [134.4, 135.82], [157.024, 158.642]])

# printed per cent: what, found, printed, whether it follows
FREQUENCY_TABLES = {
    "table 2": (INITIAL, [8.18, 9.26, 3.64, 2.71], [False, True, True, True]),
    "tables 3 and 6, optimized": (OPTIMIZED, [1.43, 1.84, 0.16, 1.34], [True, True, False, True]),
    "table 6, material tests": (FROM_TESTS, [1.72, 2.61, 1.42, 0.56], [False, False, True, True]),
}


@pytest.mark.parametrize("table", FREQUENCY_TABLES)
def test_differences_of_the_frequencies(table):
    """Equation (11). The 8.18 of mode 1 should be 8.14; 0.16, 1.72 and 2.61 should be 0.17, 1.73 and 2.62."""
    simulated, printed, follows = FREQUENCY_TABLES[table]
    found = difference_percent(simulated, GVT)
    np.testing.assert_array_equal(np.isclose(np.round(found, 2), printed, atol=1e-9), follows)
    np.testing.assert_allclose(found, printed, atol=0.04)


def test_material_tests():
    """Table 5 by its equation (13): one of seven figures does not follow from the moduli beside it."""
    E, G = 47126.0, 3927.0
    tests = [43181.0, 53588.0, 48385.0, 3650.0, 3973.0, 4163.0, 4232.0]
    printed = [9.14, 12.1, 2.6, 7.58, 1.16, 5.67, 7.21]
    found = [float(difference_percent(E if test > 10_000 else G, test)) for test in tests]
    digits = [2, 1, 1, 2, 2, 2, 2]
    follows = [round(f, d) == p for f, d, p in zip(found, digits, printed, strict=True)]
    assert follows == [True, True, True, False, True, True, True]
    # 7.59 is printed as 7.58: cut, not rounded
    assert found[3] == pytest.approx(7.589, abs=5e-4)
    # the mean of the two printed moduli
    assert pytest.approx(48385.0, abs=0.6) == (43181.0 + 53588.0) / 2


def test_a_straight_line_is_the_lowest_degree():
    """Figure 6: R² of the line exceeds 0.98, so it is taken."""
    band = confidence_band(GVT)
    assert band.degree == 1
    assert band.r_squared == pytest.approx(0.98358, abs=1e-5)
    np.testing.assert_allclose(band.coefficients, [58.445, 25.374], atol=5e-4)


def test_the_band_against_a_textbook():
    """t s √(1/n + (x − x̄)²/Sxx) with two degrees of freedom."""
    number = np.arange(1.0, 5.0)
    slope, intercept = np.polyfit(number, GVT, 1)
    s = np.sqrt(np.sum((GVT - intercept - slope * number) ** 2) / 2)
    expected = 4.302653 * s * np.sqrt(1 / 4 + (number - 2.5) ** 2 / 5)
    np.testing.assert_allclose(confidence_band(GVT).half_width_hz, expected, rtol=1e-6)


def test_the_criterion_tells_the_second_mode_alone():
    """±18.7 Hz at the ends and ±12.2 Hz inside: of the untuned model only mode 2 lies outside."""
    band = confidence_band(GVT)
    np.testing.assert_allclose(band.half_width_hz, [18.66, 12.22, 12.22, 18.66], atol=0.01)
    assert band.holds(INITIAL).tolist() == [True, False, True, True]
    assert band.holds(OPTIMIZED).all() and band.holds(FROM_TESTS).all()


def test_the_measurement_s_own_range_is_narrower_than_what_the_tuning_leaves():
    """Three of the four tuned frequencies lie outside the range that Table 2 prints for the experiment."""
    inside = (RANGES[:, 0] <= OPTIMIZED) & (RANGES[:, 1] >= OPTIMIZED)
    assert inside.tolist() == [False, False, True, False]


def test_the_gate_of_the_seed():
    assert max(2.05, 2.34, 2.89, 2.74) < 3.0


@pytest.mark.parametrize("frequencies", [[80.0, 115.0], [80.0], [1.0, 50.0, 2.0, 90.0]])
def test_no_band_where_nothing_is_left_to_estimate_a_scatter_from(frequencies):
    with pytest.raises(IdentificationError, match="too few, or rise too unevenly"):
        confidence_band(frequencies)
