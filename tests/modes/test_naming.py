import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from synthetic_shapes import PLANES_M, equidistant, shape

from statorhom.errors import IdentificationError
from statorhom.modes.naming import measured_node_planes, name_shape


@pytest.mark.parametrize("order", range(7))
@pytest.mark.parametrize("axial", range(4))
def test_known_shapes_get_their_names(order, axial):
    name = name_shape(shape(order, axial, equidistant(24)), equidistant(24), PLANES_M)
    assert (name.order, name.axial, name.kind) == (order, axial, "radial")
    assert name.share == pytest.approx(1.0)
    assert name.visibility == 1.0


@given(
    order=st.integers(0, 6),
    axial=st.integers(0, 2),
    seed=st.integers(0, 10_000),
    lost=st.floats(0, 0.3),
    exponent=st.integers(-180, 140),
    phase=st.floats(0, 6.28),
)
# squares of such small shapes are below the least number
@example(order=4, axial=1, seed=21, lost=0.1484375, exponent=-162, phase=1.234375)
@settings(deadline=None, max_examples=60)
def test_noise_lost_points_scattered_sensors_and_scale_leave_the_name(
    order, axial, seed, lost, exponent, phase
):
    rng, nominal = np.random.default_rng(seed), equidistant(24)
    placed = nominal + np.deg2rad(rng.uniform(-0.5, 0.5, 24))
    clean = shape(order, axial, placed, phase_rad=rng.uniform(0, 6))
    noise = rng.normal(size=(2, 4, 24)) + 1j * rng.normal(size=(2, 4, 24))
    radial = (clean * (1 + 0.01 * noise[0]) + 0.02 * noise[1]) * 10.0**exponent * np.exp(1j * phase)
    radial[rng.random((4, 24)) < lost] = np.nan
    name = name_shape(radial, nominal, PLANES_M)
    assert (name.order, name.axial) == (order, axial)


def test_planes_may_come_in_any_order():
    order = [2, 0, 3, 1]
    assert name_shape(shape(2, 3, equidistant(12))[order], equidistant(12), PLANES_M[order]).axial == 3


def test_a_plane_at_the_node_has_no_sign():
    z = 0.08 * np.array([0.1, 0.5, 0.9])
    radial = shape(2, 1, equidistant(12), z_m=z)
    radial[1] = -0.02 * radial[0]
    assert name_shape(radial, equidistant(12), z).axial == 1


def test_one_plane_leaves_the_node_planes_open():
    name = name_shape(np.cos(2 * equidistant(12)), equidistant(12), [0.04])
    assert (name.order, name.axial, name.axial_limit) == (2, None, 0)


def test_aliases_are_said():
    coarse = name_shape(shape(5, 0, equidistant(8)), equidistant(8), PLANES_M)
    assert (coarse.order, coarse.order_alias) == (3, 5)
    two = PLANES_M[[0, 3]]
    assert name_shape(shape(2, 2, equidistant(8), z_m=two), equidistant(8), two).axial_limit == 1


def test_an_order_that_the_points_cannot_tell_is_not_guessed():
    angles = np.deg2rad([0.0, 4.0, 8.0, 12.0, 16.0, 20.0, 24.0])
    name = name_shape(np.cos(2 * angles), angles, [0.04])
    assert (name.order, name.axial, name.kind) == (None, None, "radial")


def test_motion_that_no_order_explains_has_no_name():
    angles = np.concatenate([equidistant(12), equidistant(12)])
    contradiction = np.concatenate([np.ones(12), -np.ones(12)]) + 0.1 * np.cos(2 * angles)
    assert name_shape(contradiction, angles, [0.04]).order is None


@pytest.mark.parametrize(
    ("tangential", "axial_motion", "winding_share", "kind"),
    [(1.0, 0.1, 0.0, "torsion"), (0.1, 1.0, 0.0, "axial"), (1.0, 0.1, 0.9, "winding")],
)
def test_modes_without_radial_motion_are_named_by_their_kind(tangential, axial_motion, winding_share, kind):
    angles, ones = equidistant(12), np.ones((4, 12))
    name = name_shape(
        1e-3 * shape(2, 0, angles),
        angles,
        PLANES_M,
        tangential=tangential * ones,
        axial_motion=axial_motion * ones,
        winding_share=winding_share,
    )
    assert (name.order, name.axial, name.kind) == (None, None, kind)
    assert name.visibility < 0.02 < name.share


def test_a_mode_mostly_of_the_winding_that_the_surface_still_shows_stays_radial():
    name = name_shape(shape(2, 0, equidistant(12)), equidistant(12), PLANES_M, winding_share=0.9)
    assert (name.order, name.kind) == (2, "radial")
    assert name.visibility == pytest.approx(0.1)


def test_ring_bending_is_visible_by_its_radial_part():
    # an inextensional ring moves tangentially by 1/r of its radial motion
    angles = equidistant(24)
    tangential = -shape(2, 0, angles, phase_rad=0.4 + np.pi / 2) / 2
    name = name_shape(shape(2, 0, angles), angles, PLANES_M, tangential=tangential)
    assert name.visibility == pytest.approx(4 / 5)


def test_noise_may_hide_the_node_planes_but_not_invent_them():
    assert measured_node_planes([1.0, 0.2, -0.2, 0.3], [0, 1, 2, 3], noise=0.0) == 2
    assert measured_node_planes([1.0, 0.2, 0.5, 0.35], [0, 1, 2, 3], noise=0.1) == 0
    assert measured_node_planes([1.0, 0.2, -0.2, 0.35], [0, 1, 2, 3], noise=0.1) is None
    assert measured_node_planes([1.0, 0.2, -0.2, 0.3], [0, 1, 2, 3], noise=0.2) is None


@pytest.mark.parametrize(
    ("radial", "z", "message"),
    [
        (np.zeros((4, 12)), PLANES_M, "no motion"),
        (np.full((4, 12), np.nan), PLANES_M, "no motion"),
        (shape(2, 0, equidistant(12)), PLANES_M[:3], "4 planes needs as many axial positions, got 3"),
    ],
)
def test_bad_input_is_refused(radial, z, message):
    with pytest.raises(IdentificationError, match=message):
        name_shape(radial, equidistant(12), z)


@pytest.mark.parametrize(
    ("amplitudes", "count"),
    [
        (
            (0.38, -0.03, -0.03, 0.39),
            None,
        ),  # a mode (2, 2) whose middle hardly moves, or (2, 0) between nodes
        ((0.38, -0.01, -0.01, 0.39), None),  # nodes in both planes
        ((0.38, 0.03, 0.03, 0.39), None),
        ((0.38, 0.06, 0.06, 0.39), 0),
        ((0.38, 0.01, 0.2, 0.39), 0),
        ((0.38, -0.03, 0.03, -0.39), None),
        ((0.38, 0.03, -0.03, -0.39), 1),
    ],
)
def test_a_faint_plane_leaves_the_count_open_where_it_matters(amplitudes, count):
    assert measured_node_planes(amplitudes, (0.0, 0.03, 0.07, 0.1), noise=0.005) == count
