"""Sensor mass from pole shifts, against eigenvalues of a loaded lumped ring computed with SciPy."""

import numpy as np
import pytest
from scipy.linalg import eigh

from statorhom.errors import IdentificationError
from statorhom.modes.pole_shift import pole_shift_trend

SETUPS, MODES = 24, 4
ANGLES = 2 * np.pi * np.arange(SETUPS) / SETUPS


def structure(split=0.01):
    """Natural frequencies (Hz) and amplitudes (1/√kg) of doublets of orders 2 and 3 of a 3 kg ring."""
    f = np.array([1000.0, 1000.0 * (1 + split), 2500.0, 2500.0 * (1 + split)])
    size = np.sqrt(2 / 3.0)
    waves = [np.cos(2 * ANGLES), np.sin(2 * ANGLES), np.cos(3 * ANGLES), np.sin(3 * ANGLES)]
    return f, size * np.array(waves).T


def loaded(f, phi, mass):
    """Frequencies with the mass at each set-up, from the full eigenproblem."""
    values = [
        eigh(np.diag((2 * np.pi * f) ** 2), np.eye(f.size) + mass * np.outer(row, row), eigvals_only=True)
        for row in phi
    ]
    return np.sqrt(values) / (2 * np.pi)


@pytest.mark.parametrize("split", [1e-4, 3e-3, 0.01])
def test_mass_is_recovered_or_its_mirror_is_said(split):
    f, phi = structure(split)
    rng = np.random.default_rng(3)
    sd = np.full((SETUPS, MODES), 0.1)
    measured = loaded(f, phi, 0.004) + sd * rng.standard_normal(sd.shape)
    found = pole_shift_trend(measured, sd, phi)
    low, high = found.joint.ci90_kg
    assert found.joint.p_shift < 1e-3 and found.joint.p_mass < 1e-6 < 1e-3 < found.joint.p_rest
    if split > 1e-3:
        assert low < 0.004 < high < low + 4e-4
        assert found.mirror_kg == pytest.approx(np.full(4, 2 * split / (2 / 3)), rel=0.05)
    else:  # the mass turns the doublet, as a doublet split by itself would turn a small mass
        assert low < 2 * split / (2 / 3) < high
        assert found.mirror_kg == pytest.approx(np.full(4, 0.004), rel=0.05)


def test_no_mass_gives_no_hint_and_intervals_cover():
    f, phi = structure()
    sd = np.full((SETUPS, MODES), 0.2)
    hints, covered = 0, []
    for seed in range(20):
        noise = sd * np.random.default_rng(seed).standard_normal(sd.shape)
        none = pole_shift_trend(f + noise, sd, phi).joint
        hints += (none.p_shift < 0.01) + (none.p_mass < 0.01)
        some = pole_shift_trend(loaded(f, phi, 0.006) + noise, sd, phi).joint
        covered.append(some.ci90_kg[0] < 0.006 < some.ci90_kg[1])
    assert hints <= 3  # of 40
    assert 0.78 <= np.mean(covered) <= 0.99


def test_shifts_of_another_kind_are_not_called_a_mass():
    f, phi = structure()
    sd = np.full((SETUPS, MODES), 0.1)
    drift = f * (1 + 1e-3 * np.linspace(-1, 1, SETUPS)[:, None])  # the room warms up
    found = pole_shift_trend(drift + sd * np.random.default_rng(0).standard_normal(sd.shape), sd, phi)
    assert found.joint.p_shift < 1e-6
    assert found.joint.p_rest < 1e-6


def test_single_modes_and_predicted_shifts_agree():
    f, phi = structure(0.02)
    sd = np.full((SETUPS, MODES), 0.01)
    measured = loaded(f, phi, 0.002)
    measured[3, 1] = np.nan
    found = pole_shift_trend(measured, sd, phi)
    assert [round(1000 * mode.mass_kg, 2) for mode in found.modes] == [2.0] * 4
    assert np.isnan(found.observed[3, 1])
    there = np.isfinite(found.observed)
    np.testing.assert_allclose(found.predicted[there], found.observed[there], atol=1e-6)


def test_motion_along_the_surface_counts():
    f, phi = structure(0.02)
    both = np.stack([phi, 0.5 * np.roll(phi, 3, axis=0)], axis=2)
    values = [eigh(np.diag(f**2), np.eye(4) + 0.003 * row @ row.T, eigvals_only=True) ** 0.5 for row in both]
    found = pole_shift_trend(values, np.full((SETUPS, MODES), 0.01), both)
    assert found.joint.mass_kg == pytest.approx(0.003, rel=5e-3)


def test_sizes_must_fit():
    with pytest.raises(IdentificationError, match="one shape"):
        pole_shift_trend(np.ones((3, 2)), np.ones((3, 2)), np.ones((4, 2)))
    with pytest.raises(IdentificationError, match="three set-ups"):
        pole_shift_trend(np.ones((2, 2)), np.ones((2, 2)), np.ones((2, 2)))


def test_doublet_of_a_perfect_ring_as_one_mode():
    # the sensor turns the doublet, so its angle does not matter, but its plane does
    z = np.repeat([-1.0, -0.4, 0.4, 1.0], SETUPS)
    around = np.tile(ANGLES, 4)
    both = np.sqrt(6 / 3.0) * z[:, None] * np.column_stack([np.cos(2 * around), np.sin(2 * around)])
    bare = np.array([1000.0, 1000.0 * (1 + 1e-6)])
    moving = loaded(bare, both, 0.005)[:, :1]
    assert np.ptp(moving[z == 1.0]) < 1e-2 < np.ptp(moving)
    found = pole_shift_trend(moving, np.full(moving.shape, 0.01), both[:, None, :])
    assert found.joint.mass_kg == pytest.approx(0.005, rel=0.02)
    assert np.isnan(found.mirror_kg).all()
