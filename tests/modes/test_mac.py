import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from synthetic_shapes import equidistant, shape

from statorhom.errors import IdentificationError
from statorhom.modes.mac import mac, mac_matrix, subspace_mac


def _random(seed, *size):
    rng = np.random.default_rng(seed)
    return rng.normal(size=size) + 1j * rng.normal(size=size)


def _doublet(order, angles):
    return np.column_stack([shape(order, 0, angles, phase_rad=p).ravel() for p in (0.0, np.pi / 2)])


@given(seed=st.integers(0, 999), exponent=st.integers(-150, 150), phase=st.floats(0, 6.28))
@settings(deadline=None, max_examples=40)
def test_mac_ignores_scale_and_phase_and_is_symmetric(seed, exponent, phase):
    a, b = _random(seed, 30), _random(seed + 1, 30)
    expected = abs(np.vdot(a, b)) ** 2 / (np.vdot(a, a) * np.vdot(b, b)).real
    scaled = a * 10.0**exponent * np.exp(1j * phase)
    assert mac(a, scaled) == pytest.approx(1.0)
    assert mac(scaled, b) == pytest.approx(expected)
    assert mac(b, scaled) == pytest.approx(expected)


def test_orthogonal_shapes_have_no_mac():
    angles = equidistant(24)
    assert mac(shape(2, 0, angles), shape(3, 0, angles)) == pytest.approx(0.0, abs=1e-12)


@given(orientation=st.floats(0, 6.28))
@settings(deadline=None, max_examples=20)
def test_a_doublet_is_recognised_in_any_orientation(orientation):
    angles = equidistant(24)
    measured = shape(2, 0, angles, phase_rad=orientation, factor=np.exp(1j)).ravel()
    assert subspace_mac(measured, _doublet(2, angles)) == pytest.approx(1.0)
    assert subspace_mac(measured, _doublet(3, angles)) == pytest.approx(0.0, abs=1e-12)


@given(seed=st.integers(0, 999))
@settings(deadline=None, max_examples=20)
def test_subspace_mac_depends_on_the_spans_only(seed):
    first, second, mixing = _random(seed, 30, 2), _random(seed + 1, 30, 2), _random(seed + 2, 2, 2)
    value = subspace_mac(first, second)
    assert 0.0 <= value <= 1.0
    assert subspace_mac(first @ mixing, second) == pytest.approx(value)
    assert subspace_mac(first, first @ mixing) == pytest.approx(1.0)


def test_a_doublet_measured_twice_the_same_way_counts_as_one_shape():
    angles = equidistant(24)
    one = shape(2, 0, angles).ravel()
    assert subspace_mac(np.column_stack([one, -3j * one]), _doublet(2, angles)) == pytest.approx(1.0)


def test_points_missing_in_either_shape_are_left_out():
    a, b = _random(1, 20), _random(2, 20)
    expected = mac(a[3:-2], b[3:-2])
    a[:3], b[-2:] = np.nan, np.nan
    assert mac(a, b) == pytest.approx(expected)


def test_matrix_of_single_shapes_and_doublets():
    angles = equidistant(24)
    measured = [shape(3, 0, angles, phase_rad=1.0).ravel(), shape(2, 0, angles, phase_rad=2.0).ravel()]
    matrix = mac_matrix(measured, [_doublet(2, angles), _doublet(3, angles), shape(0, 0, angles).ravel()])
    assert matrix == pytest.approx(np.array([[0, 1, 0], [1, 0, 0]]), abs=1e-12)
    assert mac_matrix([], measured).shape == (0, 2)


def test_shapes_that_cannot_be_compared_are_refused():
    with pytest.raises(IdentificationError, match="at 3 and at 4 points"):
        mac(np.ones(3), np.ones(4))
    with pytest.raises(IdentificationError, match="does not move"):
        mac(np.ones(3), np.zeros(3))
    with pytest.raises(IdentificationError, match="does not move"):
        mac([1.0, np.nan], [np.nan, 1.0])
