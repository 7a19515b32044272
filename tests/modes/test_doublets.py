"""Doublets against the exact 2 × 2 eigenproblem of a perturbed pair."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from statorhom.modes.antinode import Antinode
from statorhom.modes.doublets import complex_split, find_doublets

OMEGA_SQUARED = (2 * np.pi * 1500.0) ** 2
ANGLES = 2 * np.pi * np.arange(24) / 24


def perturbed(r, stiffness=0.0, mass=0.0, theta=0.0):
    """Frequencies (Hz) and antinodes of a unit-modal-mass doublet with a spring and a lump at theta."""
    phi = np.array([np.cos(r * theta), np.sin(r * theta)])
    matrix = OMEGA_SQUARED * (np.eye(2) - mass * np.outer(phi, phi)) + stiffness * np.outer(phi, phi)
    values, vectors = np.linalg.eigh(matrix)
    places = [Antinode(r, float(np.arctan2(v[1], v[0]) / r % (np.pi / r)), 0.01, 1.0) for v in vectors.T]
    return np.sqrt(values) / (2 * np.pi), places


@settings(deadline=None)
@given(st.integers(1, 8), st.floats(0, 6.28), st.booleans())
def test_the_split_points_at_a_stiffness_and_away_from_a_mass(r, theta, is_mass):
    size = 0.01
    f, (lower, upper) = perturbed(r, 0.0 if is_mass else size * OMEGA_SQUARED, size * is_mass, theta)
    split, _ = complex_split(lower, upper, tuple(f), (0.1, 0.1))
    expected = size * OMEGA_SQUARED * np.exp(1j * (2 * r * theta + np.pi * is_mass))
    assert abs(split - expected) < 1e-6 * abs(expected)


def test_covariance_of_the_split_is_what_noise_makes_of_it():
    rng = np.random.default_rng(7)
    f, (lower, upper) = perturbed(3, 0.02 * OMEGA_SQUARED, theta=0.4)
    drawn = []
    for _ in range(4000):
        turned = [Antinode(3, p.angle_rad + 0.01 * rng.standard_normal(), 0.01, 1.0) for p in (lower, upper)]
        noisy = tuple(f + 0.5 * rng.standard_normal(2))
        drawn.append(complex_split(*turned, noisy, (0.5, 0.5))[0])
    observed = np.cov(np.real(drawn), np.imag(drawn))
    _, expected = complex_split(lower, upper, tuple(f), (0.5, 0.5))
    np.testing.assert_allclose(observed, expected, atol=0.08 * np.abs(expected).max())


def modes(*entries):
    places = [Antinode(r, angle % (np.pi / r), 0.01, 1.0) for r, angle, _ in entries]
    shapes = [np.cos(r * (ANGLES - angle)) for r, angle, _ in entries]
    return places, np.array([f for *_, f in entries]), shapes


def test_pairs_are_told_from_absorber_pairs_and_from_other_names():
    places, f, shapes = modes(
        (2, 0.1, 1000.0), (2, 0.1 + np.pi / 4, 1004.0), (2, 0.1, 1200.0), (2, 0.1 + np.pi / 4, 1203.0),
        (3, 0.0, 1201.0), (2, 0.12, 1002.0),
    )  # fmt: skip
    axial = [0, 0, 0, 0, 0, 1]
    pairs = find_doublets(axial, places, f, np.full(6, 0.1), shapes)
    assert sorted((p.lower, p.upper) for p in pairs) == [(0, 1), (2, 3)]
    for pair in pairs:
        assert pair.rotation_rad == pytest.approx(pair.ideal_rotation_rad) == pytest.approx(np.pi / 4)
        assert pair.mac == pytest.approx(0.0, abs=1e-12)
        assert pair.rotation_sd_rad == pytest.approx(0.01 * np.sqrt(2))


def test_one_mode_found_twice_is_no_doublet():
    places, f, shapes = modes((2, 0.1, 1000.0), (2, 0.12, 1004.0))
    assert find_doublets([0, 0], places, f, np.full(2, 0.1), shapes) == ()


def test_equal_frequencies_and_modes_without_an_angle():
    places, f, shapes = modes((2, 0.1, 1000.0), (2, 0.1 + np.pi / 4, 1000.0), (2, 0.3, 1000.0))
    pairs = find_doublets([0, 0, 0], [*places[:2], None], f, np.full(3, 0.1), shapes)
    assert [(p.lower, p.upper) for p in pairs] == [(0, 1)]
    assert pairs[0].split == 0


@settings(deadline=None, max_examples=30)
@given(st.integers(1, 6), st.floats(0, 6.28), st.floats(0.0, 0.2))
def test_rotation_does_not_depend_on_where_the_pair_lies(r, start, error):
    assume(r * error < np.radians(35))
    places, f, shapes = modes((r, start, 1000.0), (r, start + np.pi / (2 * r) - error, 1004.0))
    (pair,) = find_doublets([0, 0], places, f, np.full(2, 0.1), shapes)
    assert pair.rotation_rad == pytest.approx(np.pi / (2 * r) - error, abs=1e-9)
