import numpy as np
import pytest

from statorhom.modes.resolved_motion import resolve_motion

R, T, Z = np.eye(3)


def resolve(directions, values, sd=None):
    values = np.array(values, dtype=complex)
    deviation = np.full(values.size, np.nan) if sd is None else np.array(sd)
    return resolve_motion(np.array(directions), values, deviation)


def test_repeats_are_averaged_by_their_weights():
    found = resolve([R, R], [1.0, 2.0], [0.1, 0.2])
    assert found.motion[0] == pytest.approx(1.2)
    assert found.sd[0] == pytest.approx(1 / np.sqrt(1 / 0.01 + 1 / 0.04))
    assert np.isnan(found.motion[1:]).all()


def test_a_sensor_turned_round_counts_with_its_sign():
    assert resolve([R, -R], [1.0, -3.0]).motion[0] == pytest.approx(2.0)


def test_two_skew_sensors_span_radial_and_tangential():
    c, s = np.cos(0.7), np.sin(0.7)
    motion = np.array([0.3 + 1j, -0.8, 0.0])
    directions = np.array([[c, s, 0], [s, -c, 0]])
    found = resolve(directions, directions @ motion)
    assert found.motion[:2] == pytest.approx(motion[:2])
    assert np.isnan(found.motion[2])


def test_one_skew_sensor_spans_nothing():
    assert np.isnan(resolve([[np.sqrt(0.5), np.sqrt(0.5), 0]], [1.0]).motion).all()


def test_three_sensors_with_a_missing_value():
    found = resolve([R, T, Z], [1.0, np.nan, 3.0])
    assert found.motion[[0, 2]] == pytest.approx([1.0, 3.0])
    assert np.isnan(found.motion[1])


def test_repeats_that_noise_explains_and_repeats_that_contradict():
    assert resolve([R, R], [1.0, 1.1], [0.1, 0.1]).p_repeats > 0.1
    assert resolve([R, R], [1.0, 2.0], [0.1, 0.1]).p_repeats < 1e-6


def test_probability_of_repeats_is_uniform_under_noise():
    rng = np.random.default_rng(0)
    noise = (rng.standard_normal((2000, 3)) + 1j * rng.standard_normal((2000, 3))) / np.sqrt(2)
    p = np.array([resolve([R, R, R], row, [1.0, 1.0, 1.0]).p_repeats for row in noise])
    assert np.mean(p < 0.05) == pytest.approx(0.05, abs=0.02)
