"""Circle and flanks: silent on linear modes, loud on Duffing's and Jenkins' ones."""

import numpy as np
import pytest
from oscillators import duffing, jenkins, receptance

from measured_points import complex_noise
from statorhom.errors import IdentificationError
from statorhom.modes.nonlinearity.circle_distortion import circle_distortion
from statorhom.modes.nonlinearity.flank_asymmetry import flank_asymmetry
from statorhom.modes.nonlinearity.frf_noise import line_noise
from statorhom.modes.nonlinearity.mode_lines import lines_around
from statorhom.modes.nonlinearity.resonance_fit import fit_resonance

MASS, F0, ETA = 1.0, 1000.0, 0.01
K = MASS * (2 * np.pi * F0) ** 2
AXIS = np.arange(960.0, 1040.0, 0.5)  # 20 lines in a half-power width
PEAK = 1 / (ETA * K)


def linear(viscous=False, neighbour_hz=1100.0):
    omega = 2 * np.pi * AXIS
    loss = ETA * 2 * np.pi * F0 * omega * MASS if viscous else ETA * K
    other = 0.7 / ((2 * np.pi * neighbour_hz) ** 2 * (1 + 0.02j) - omega**2)
    return (1 + 0.1j) / (K + 1j * loss - MASS * omega**2) + other


def noisy(frf, seed, relative=0.01):
    return frf + complex_noise(np.random.default_rng(seed), frf.shape, relative * np.abs(frf).max())


def probabilities(test, known, viscous, runs):
    frf = linear(viscous)
    sd = np.full(AXIS.size, 0.01 * np.abs(frf).max()) if known else None
    return np.array([test(AXIS, noisy(frf, seed), F0, ETA, sd).p for seed in range(runs)])


@pytest.mark.parametrize("test", [circle_distortion, flank_asymmetry])
@pytest.mark.parametrize("known", [True, False])
def test_linear_modes_give_no_hint(test, known):
    # 1 % of 60 is 0.6; four or more would happen once in 300 runs
    assert np.count_nonzero(probabilities(test, known, True, 60) < 0.01) <= 3


@pytest.mark.parametrize("test", [circle_distortion, flank_asymmetry])
@pytest.mark.parametrize("split", [0.2, 0.6, 1.5])
def test_a_doublet_is_no_bent_peak(test, split):
    partner = F0 * (1 + split * ETA)
    frf = linear() + 0.5 / ((2 * np.pi) ** 2 * (partner**2 * (1 + 1j * ETA) - AXIS**2))
    p = [test(AXIS, noisy(frf, s), F0, ETA, neighbours=[(partner, ETA), (5e3, 0.1)]).p for s in range(40)]
    assert np.count_nonzero(np.array(p) < 0.01) <= 3
    bent = receptance(AXIS, 1.0, MASS, duffing(K, ETA, 0.8 * ETA * K / PEAK**2))
    if test is flank_asymmetry and split > 1:  # a partner farther off does not hide a bent peak
        assert test(AXIS, noisy(bent, 1), F0, ETA, neighbours=[(partner, ETA)]).p < 0.01


@pytest.mark.slow
@pytest.mark.parametrize("test", [circle_distortion, flank_asymmetry])
@pytest.mark.parametrize("known", [True, False])
@pytest.mark.parametrize("viscous", [False, True])
def test_false_alarms_are_as_rare_as_stated(test, known, viscous):
    p = probabilities(test, known, viscous, 1000)
    assert np.mean(p < 0.01) <= 0.01 + 3 * np.sqrt(0.01 * 0.99 / 1000)
    assert np.mean(p < 0.3) <= 0.3 + 3 * np.sqrt(0.3 * 0.7 / 1000)


def test_a_hard_spring_bends_the_peak_but_leaves_the_circle():
    # cubic stiffness without further loss: 1/H keeps its imaginary part, so the Nyquist plot stays a circle
    frf = receptance(AXIS, 1.0, MASS, duffing(K, ETA, 0.4 * ETA * K / PEAK**2))
    hints = [flank_asymmetry(AXIS, noisy(frf, seed), F0, ETA) for seed in range(10)]
    assert max(hint.p for hint in hints) < 1e-3
    assert {hint.steeper for hint in hints} == {"upper"}
    assert np.mean([hint.stiffness_change for hint in hints]) == pytest.approx(0.75 * 0.4 * ETA, rel=0.1)
    assert min(circle_distortion(AXIS, noisy(frf, seed), F0, ETA).p for seed in range(10)) > 1e-3


def test_a_soft_spring_bends_it_the_other_way():
    frf = receptance(AXIS, 1.0, MASS, duffing(K, ETA, -0.4 * ETA * K / PEAK**2))
    hint = flank_asymmetry(AXIS, noisy(frf, 3), F0, ETA)
    assert hint.p < 1e-3 and hint.steeper == "lower" and hint.asymmetry > 3 * hint.asymmetry_sd


def test_dry_friction_distorts_the_circle():
    slider = 0.02 * K
    frf = receptance(AXIS, 1.0, MASS, jenkins(K, ETA, slider, slider * 0.3 * PEAK))
    for seed in range(5):
        hint = circle_distortion(AXIS, noisy(frf, seed, 0.005), F0, 0.015)
        assert hint.p < 1e-3
        assert hint.distortion > 0.005
    slight = receptance(AXIS, 0.01, MASS, jenkins(K, ETA, slider, slider * 0.3 * PEAK))  # it sticks
    assert circle_distortion(AXIS, noisy(slight, 1, 0.005), F0 * np.sqrt(1.02), ETA).p > 0.001


def test_asymmetry_is_that_of_the_half_power_points():
    frf = receptance(AXIS, 1.0, MASS, duffing(K, ETA, 0.3 * ETA * K / PEAK**2))
    hint = flank_asymmetry(AXIS, noisy(frf, 0, 1e-4), F0, ETA)
    fine = np.linspace(980, 1020, 2001)
    power = np.abs(receptance(fine, 1.0, MASS, duffing(K, ETA, 0.3 * ETA * K / PEAK**2))) ** 2
    x = fine[[int(np.argmax(power)), *np.flatnonzero(power > power.max() / 2)[[0, -1]]]] ** 2
    assert hint.asymmetry == pytest.approx((x[1] + x[2] - 2 * x[0]) / (x[2] - x[1]), abs=0.02)


def test_radius_is_half_the_modal_constant_over_its_damping():
    found = circle_distortion(AXIS, noisy(linear(), 2), F0, ETA)
    assert abs(found.radius - abs(1 + 0.1j) * PEAK / 2) < 4 * found.radius_sd
    assert found.radius_sd < 0.1 * found.radius


@pytest.mark.parametrize(("floor", "relative"), [(0.01, 0.0), (0.001, 0.01), (0.003, 0.005)])
def test_noise_is_found_from_the_lines(floor, relative):
    top = np.abs(linear()).max()
    sd = np.hypot(floor * top, relative * np.abs(linear()))
    rng = np.random.default_rng(4)
    found = [line_noise(linear() + complex_noise(rng, AXIS.shape, sd))[0] / sd for _ in range(50)]
    assert np.mean(found) == pytest.approx(1.0, abs=0.12)
    assert np.mean(found, axis=0) == pytest.approx(np.ones(AXIS.size), abs=0.35)


def test_standard_deviation_of_the_bend_is_what_repeats_show():
    frf = linear()
    sd = np.full(AXIS.size, 0.01 * np.abs(frf).max())
    lines = [lines_around(AXIS, noisy(frf, s), F0, ETA, sd) for s in range(60)]
    fits = [fit_resonance(one, F0, ETA, bent=True) for one in lines]
    assert np.std([fit.bend / fit.bend_sd for fit in fits]) == pytest.approx(1.0, abs=0.3)
    assert np.mean([fit.misfit / fit.freedom for fit in fits]) == pytest.approx(1.0, abs=0.1)
    assert np.mean([fit.loss_factor for fit in fits]) == pytest.approx(ETA, rel=0.02)


@pytest.mark.parametrize("test", [circle_distortion, flank_asymmetry])
def test_lines_without_noise_can_be_judged(test):
    assert 0.0 <= test(AXIS, linear(), F0, ETA).p <= 1.0


@pytest.mark.parametrize("test", [circle_distortion, flank_asymmetry])
def test_few_lines_are_said(test):
    with pytest.raises(IdentificationError, match="lines around the mode at 1000 Hz"):
        test(AXIS[::10], linear()[::10], F0, ETA)
