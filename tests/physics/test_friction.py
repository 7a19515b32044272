"""Harmonic balance of slipping contacts against loops that are integrated in time."""

from __future__ import annotations

import numpy as np
import pytest

from statorhom.physics.friction import iwan_resonance, jenkins, jenkins_resonance


def jenkins_loop(ratio: float, steps: int = 40000) -> tuple[float, float]:
    """First harmonic of the force of a unit spring behind a unit slider, over a sine of amplitude `ratio`."""
    phase = np.linspace(0, 4 * np.pi, 2 * steps, endpoint=False)
    x = ratio * np.cos(phase)
    force, slider = np.empty_like(x), 0.0
    for i, value in enumerate(x):
        spring = np.clip(value - slider, -1.0, 1.0)
        slider = value - spring
        force[i] = spring
    last = slice(steps, None)  # the first turn settles
    return (
        float(2 * np.mean(force[last] * np.cos(phase[last])) / ratio),
        float(-2 * np.mean(force[last] * np.sin(phase[last])) / ratio),
    )


@pytest.mark.parametrize("ratio", [0.5, 1.0, 1.3, 3.0, 20.0])
def test_a_jenkins_element_is_the_first_harmonic_of_its_loop(ratio: float) -> None:
    assert jenkins(ratio) == pytest.approx(jenkins_loop(ratio), abs=2e-3)


@pytest.mark.parametrize("force", [0.02, 0.5, 2.0, 30.0])
def test_a_slipping_mode_balances_its_force(force: float) -> None:
    """At resonance all of the force meets dissipation: X (λη + Im k) = F."""
    share, loss = 0.05, 0.004
    found = jenkins_resonance(share, loss, force)
    # the amplitude over the limit of sticking, by bisection of the balance itself
    low, high = 1e-6, 1e6
    for _ in range(200):
        y = np.sqrt(low * high)
        dissipated = y * (loss / share + jenkins(y)[1])
        low, high = (low, y) if dissipated > force else (y, high)
    real, imaginary = jenkins(low)
    assert found.fall == pytest.approx(share * (1 - real), abs=1e-9)
    assert found.loss * (1 - found.fall) == pytest.approx(share * imaginary, abs=1e-9)


def test_stiffness_falls_with_the_level_and_damping_rises_first() -> None:
    levels = [jenkins_resonance(0.05, 0.004, f) for f in (0.01, 0.5, 1.0, 1.3)]
    assert levels[0].fall == levels[0].loss == 0.0
    assert np.all(np.diff([one.fall for one in levels[:3]]) > 0)
    assert np.all(np.diff([one.loss for one in levels[:3]]) > 0)
    # what slips all the time dissipates little for its amplitude
    assert jenkins_resonance(0.05, 0.004, 50.0).loss < 0.2 * max(one.loss for one in levels)


@pytest.mark.parametrize("exponent", [-0.8, -0.3])
def test_micro_slip_dissipates_as_the_amplitude_to_chi_plus_three(exponent: float) -> None:
    """Masing's loop of the backbone x - d x^(χ+2), integrated, and the exponent of the dissipation."""
    drop, loss = 1e-3, 0.01
    for force in (0.002, 0.01):
        found = iwan_resonance(drop, exponent, loss, force)
        amplitude = (found.fall / drop) ** (1 / (exponent + 1))
        x = np.linspace(0, amplitude, 200001)
        backbone = x - drop * x ** (exponent + 2)
        loop = 8 * np.trapezoid(backbone, x) - 4 * amplitude * backbone[-1]
        assert found.loss * (1 - found.fall) == pytest.approx(loop / (np.pi * amplitude**2), rel=1e-4)
        assert amplitude * (loss + found.loss * (1 - found.fall)) == pytest.approx(force, rel=1e-6)
    small, large = (iwan_resonance(drop, exponent, loss, f) for f in (1e-4, 1e-3))
    ratio = (large.fall / small.fall) ** (1 / (exponent + 1))
    energy = large.loss * (1 - large.fall) / (small.loss * (1 - small.fall)) * ratio**2
    assert np.log(energy) / np.log(ratio) == pytest.approx(exponent + 3, rel=1e-6)
