"""Where the points of a plane contradict each other, their mean says nothing of a sensor."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from statorhom.diagnose.measured.measured_test import PlaneShifts
from statorhom.diagnose.measured.plane_shifts import (
    _by_plane,
    _is_inside,
    _may_be_a_sensors,
    distinct_doublets,
    doubtful_axial,
    stands_off,
    strongest,
)

PLANES = (0.01, 0.04)
LOSS = 0.01
SD = 1e-5


def shifts(scatter: float, points: int = 24) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Heights, shifts and their standard deviations of two planes whose poles lie 1e-3 apart."""
    rng = np.random.default_rng(3)
    heights = np.repeat(PLANES, points)
    moved = np.where(heights > PLANES[0], 5e-4, -5e-4) + scatter * rng.standard_normal(len(heights))
    return heights, moved, np.full(len(heights), SD)


def test_points_that_agree_tell_the_shift_of_their_plane() -> None:
    found = _by_plane("1", *shifts(SD), LOSS)
    assert found is not None
    assert found.shift == pytest.approx([-5e-4, 5e-4], abs=1e-5)
    assert np.all(found.sd < SD)


def test_points_that_contradict_each_other_do_not() -> None:
    assert _by_plane("1", *shifts(20 * SD), LOSS) is None


def test_one_plane_tells_no_trend() -> None:
    heights, moved, sd = shifts(SD)
    assert _by_plane("1", heights[:24], moved[:24], sd[:24], LOSS) is None


def test_points_may_differ_by_little_of_what_the_planes_differ() -> None:
    """By five standard deviations more than points may differ, but by a twentieth of the trend."""
    heights, moved, sd = shifts(5e-5)
    found = _by_plane("1", heights, moved, sd / 4, LOSS)
    assert found is not None
    assert found.shift == pytest.approx([-5e-4, 5e-4], abs=5e-5)


def mode(frequency_hz: float, order: int, axial: int, size: float, loss: float = LOSS) -> Any:
    own = SimpleNamespace(
        frequency_hz=frequency_hz,
        loss_factor=loss,
        participation=np.array([size]),
        shape=np.ones(4),
        bandwidth_hz=loss * frequency_hz,
    )
    return SimpleNamespace(mode=own, order=order, axial=axial)


# a doublet at the planes where the sensor moves it, its image at the planes where it does not, and a neighbour
MODES = (
    mode(3199.6, 3, 1, 5.0),
    mode(3199.7, 3, 1, 5.0),
    mode(3203.2, 3, 1, 4.0),
    mode(3203.3, 3, 3, 4.0),
    mode(3215.0, 1, 1, 6.0),
    mode(4400.0, 3, 1, 4.0),
    mode(4400.2, 3, 1, 4.0),
)
DOUBLETS = tuple(SimpleNamespace(lower=i, upper=i + 1) for i in (0, 2, 5))


def test_the_weaker_image_of_a_doublet_is_none() -> None:
    measured: Any = SimpleNamespace(modes=MODES, doublets=DOUBLETS)
    assert [d.lower for d in distinct_doublets(measured)] == [0, 5]


def test_poles_of_other_damping_are_no_doublet() -> None:
    halves = (mode(3199.6, 3, 1, 5.0), mode(3199.7, 3, 1, 5.0, 1.9 * LOSS))
    images = (mode(4400.0, 3, 1, 4.0), mode(4400.2, 3, 1, 4.0, 2.1 * LOSS))
    measured: Any = SimpleNamespace(
        modes=halves + images, doublets=[SimpleNamespace(lower=i, upper=i + 1) for i in (0, 2)]
    )
    assert [d.lower for d in distinct_doublets(measured)] == [0]


def test_of_a_doublet_that_no_point_parts_one_mode_is_kept() -> None:
    assert strongest(MODES, set()) == [0, 1, 4, 5, 6]
    bigger = (*MODES[:1], mode(3199.7, 3, 1, 5.5), *MODES[2:])
    assert strongest(bigger, set()) == [1, 4, 5, 6]


def test_images_that_count_other_node_planes_make_the_name_doubtful() -> None:
    assert doubtful_axial(MODES, [0, 1, 4, 5, 6]) == {0, 1}
    assert doubtful_axial((*MODES[:3], MODES[2], *MODES[4:]), [0, 1, 4, 5, 6]) == set()


def test_images_do_not_hide_the_mode_s_own_pole_but_neighbours_do() -> None:
    assert not stands_off(MODES, 1, [1, 4, 5])
    assert stands_off(MODES, 1, [1, 5])
    images = (*MODES[:3], mode(3203.3, 3, 3, 4.0), *MODES[4:])
    assert stands_off(images, 1, [1, 5])


def test_poles_that_all_lie_far_on_one_side_are_a_neighbours() -> None:
    heights, moved, sd = shifts(SD)
    assert _by_plane("1", heights, moved + 0.02, sd, LOSS) is None


def test_a_modes_own_pole_may_be_that_of_one_plane() -> None:
    heights, moved, sd = shifts(SD)
    found = _by_plane("1", heights, moved + 5e-4, sd, LOSS)
    assert found is not None
    assert found.mean == pytest.approx(5e-4, abs=1e-5)


def test_a_short_cores_two_families_of_one_order_are_no_images() -> None:
    """They lie within a percent of each other, the one symmetric along the axis and the other not."""
    modes = (mode(1514.5, 2, 0, 4.0), mode(1520.0, 2, 1, 5.0))
    assert strongest(modes, set()) == [0, 1]
    assert doubtful_axial(modes, [0, 1]) == set()
    assert not stands_off(modes, 1, [0, 1])


def shown(*amplitudes: float) -> Any:
    """A mode of order 2 with amplitudes at as many planes."""
    along = np.array(amplitudes)
    spectrum = SimpleNamespace(signed_amplitudes=lambda _: along)
    places = np.linspace(0.01, 0.07, len(along))
    return SimpleNamespace(
        order=2, name=SimpleNamespace(spectrum=spectrum), shape=SimpleNamespace(z_m=places)
    )


def of_planes(one: Any, *shift: float) -> PlaneShifts:
    moved = np.array(shift)
    return PlaneShifts("1", one.shape.z_m, moved - moved.mean(), np.full(len(moved), 2e-5), 0.0)


def test_a_mass_pulls_a_pole_down_where_the_mode_moves_most() -> None:
    one = shown(1.0, 0.3, -0.3, -1.0)
    assert _may_be_a_sensors(of_planes(one, -1e-3, -1e-4, -1e-4, -1e-3), one)
    assert not _may_be_a_sensors(of_planes(one, 1e-3, 1e-4, 1e-4, 1e-3), one)
    # both ends move alike: what pulls at one of them alone is no mass that roves
    assert not _may_be_a_sensors(of_planes(one, -1e-3, -1e-4, -1e-4, -1e-4), one)


def test_poles_that_hardly_move_may_be_anybodys() -> None:
    one = shown(1.0, 0.3, -0.3, -1.0)
    assert _may_be_a_sensors(of_planes(one, 5e-5, -5e-5, 0.0, 2e-5), one)


def test_single_frfs_tell_no_pole_at_the_end_of_the_band() -> None:
    assert _is_inside(mode(1000.0, 2, 0, 1.0), (100.0, 1100.0))
    assert not _is_inside(mode(1000.0, 2, 0, 1.0), (100.0, 1015.0))
    assert not _is_inside(mode(1000.0, 2, 0, 1.0), (985.0, 5000.0))
