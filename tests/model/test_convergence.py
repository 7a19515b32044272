"""Extrapolation over meshes."""

import numpy as np
import pytest

from statorhom.model.convergence import ORDERS, USUAL_ORDER, converge, extrapolate, mode_keys
from statorhom.model.free_modes import FreeModes
from statorhom.model.stator_mode import StatorMode

SIZES = np.array([1.0, 1 / 1.5, 1 / 2.0])


def mode(frequency, order=2, axial=0, visibility=0.5, column=0):
    return StatorMode(frequency, order, axial, "radial", visibility, 2, 0, column)


def solution(*modes):
    return FreeModes(tuple(sorted(modes, key=lambda m: m.frequency_hz)), (), (), ())


@pytest.mark.parametrize("p", [1.3, 1.6, 2.0, 2.8])
@pytest.mark.parametrize("constant", [30.0, -30.0])
def test_a_power_of_the_size_is_extrapolated_exactly(p, constant):
    limit, sd = extrapolate(SIZES, 1000.0 + constant * SIZES**p)
    assert limit == pytest.approx(1000.0, abs=0.05)
    assert 0.0 < sd < 10.0


def test_an_order_beyond_what_is_possible_is_not_believed():
    steep = 1000.0 + 30.0 * SIZES**6
    limit, _ = extrapolate(SIZES, steep)
    a, b = SIZES[1] ** ORDERS[1], SIZES[2] ** ORDERS[1]
    assert limit == pytest.approx((steep[2] * a - steep[1] * b) / (a - b))


def test_a_series_that_turns_tells_no_order():
    turning = np.array([1010.0, 1000.0, 1004.0])
    limit, sd = extrapolate(SIZES, turning)
    assert limit == extrapolate(SIZES[1:], turning[1:])[0]  # the usual order
    assert limit > 1004.0
    assert sd > 1.0


def test_two_meshes_use_the_usual_order_and_one_its_own_doubt():
    pair = 1000.0 + 30.0 * SIZES[:2] ** USUAL_ORDER
    assert extrapolate(SIZES[:2], pair)[0] == pytest.approx(1000.0)
    assert extrapolate(SIZES[:1], np.array([1000.0])) == (1000.0, 10.0)


def test_equal_frequencies_leave_no_error():
    assert extrapolate(SIZES, np.full(3, 1000.0)) == pytest.approx((1000.0, 0.0), abs=1e-9)


def test_modes_are_followed_by_name_and_frequency():
    # the faint mode at 1500 is visible on the fine mesh alone, and the one at 2000 is lost there
    coarse = solution(mode(1010.0), mode(1600.0), mode(2000.0, 3), mode(900.0, None, None))
    fine = solution(mode(1004.0), mode(1500.0), mode(1590.0), mode(2600.0, 3))
    found = converge([1.0, 0.5], [100, 800], [coarse, fine])
    assert [c.key for c in found] == [(2, 0, 0), (2, 0, 1)]
    assert found[1].frequency_hz == (1600.0, 1590.0)
    assert found[0].dof == (100, 800)
    assert found[0].factor == pytest.approx(found[0].extrapolated_hz / 1010.0)
    assert found[0].extrapolated_hz < 1004.0
    assert found[0].sd > 0.0


def test_a_finer_mesh_is_softer_and_no_two_modes_become_one():
    coarse = solution(mode(4090.0), mode(4700.0))
    # what the coarse mesh has at 4090 Hz has another name on the fine one
    fine = solution(mode(4300.0), mode(4650.0))
    found = converge([1.0, 1 / 1.5], [100, 300], [coarse, fine])
    assert [c.frequency_hz for c in found] == [(4700.0, 4650.0)]
    both = converge(
        [1.0, 1 / 1.5], [100, 300], [solution(mode(4500.0), mode(4700.0)), solution(mode(4480.0))]
    )
    assert [c.frequency_hz for c in both] == [(4500.0, 4480.0)]


def test_soft_teeth_take_no_other_modes_place():
    """A mode falls by 5 %, and one of another name falls next to where it was and bears its name now."""
    coarse = solution(mode(2895.0), mode(5172.0, visibility=0.58, column=1))
    fine = solution(
        mode(2860.0), mode(4899.0, visibility=0.5, column=1), mode(5158.0, visibility=0.32, column=2)
    )
    found = converge([1.0, 1 / 1.5], [100, 300], [coarse, fine])
    assert [c.frequency_hz for c in found] == [(2895.0, 2860.0), (5172.0, 4899.0)]


def test_modes_that_change_places_leave_open_which_is_which():
    """A clean stack's (3, 1) at 10.3 kHz was 11 standard deviations off: a tooth's mode had passed it (65232)."""
    coarse = solution(
        mode(9075.0, 3, 3, 0.004, 1), mode(10271.0, 3, 1, 0.40, 2), mode(10533.0, 3, 1, 0.27, 3)
    )
    fine = solution(mode(9049.0, 3, 3, 0.007, 1), mode(9694.0, 3, 3, 0.12, 2), mode(10254.0, 3, 1, 0.51, 3))
    found = {c.key: c for c in converge([1.0, 1 / 1.5], [100, 200], [coarse, fine])}
    assert found[3, 3, 0].doubt == 0.0
    assert found[3, 1, 0].doubt == pytest.approx(np.log(10254.0 / 9694.0))


def test_keys_count_modes_of_one_name_from_below():
    modes = [mode(1000.0), mode(1100.0, 2, 1), mode(1200.0), mode(1300.0, None, None)]
    assert list(mode_keys(modes)) == [(2, 0, 0), (2, 1, 0), (2, 0, 1)]
    assert mode_keys(modes)[(2, 0, 1)].frequency_hz == 1200.0
