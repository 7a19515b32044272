"""Recordings of prescribed modes against closed forms."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from statorhom.conceal.frfs import Observation, accelerance, frf_set
from statorhom.conceal.friction import jenkins, slipping_curves
from statorhom.conceal.sensors import ANGLES, PLANES, sensors
from statorhom.conceal.truth import Slip

PLACES = sensors(0.06, 0.08, 2, np.random.default_rng(1))
F0, ETA, MASS = 1000.0, 0.002, 3.0


class Ovals:
    """One doublet of order 2 with radial and tangential motion, as a thin ring of a mass has it."""

    eigenvalues = np.full(2, (2 * np.pi * F0) ** 2)
    loss_factors = np.full(2, ETA)

    def motion(self, angles: np.ndarray, z: np.ndarray) -> np.ndarray:
        del z
        radial = np.stack([np.cos(2 * angles), np.sin(2 * angles)], axis=-1)
        tangential = 0.5 * np.stack([-np.sin(2 * angles), np.cos(2 * angles)], axis=-1)
        shape = np.stack([radial, tangential, 0 * radial], axis=1)
        return shape * np.sqrt(2 / MASS * 4 / 5)


def peak_hz(lines: np.ndarray, row: np.ndarray) -> float:
    level = np.abs(row / lines**2)
    i = int(np.argmax(level))
    a, b, c = level[i - 1 : i + 2] ** -2.0
    return float(lines[i] + 0.5 * (a - c) / (a - 2 * b + c) * (lines[1] - lines[0]))


def test_the_grid_is_where_the_file_says_within_half_a_degree() -> None:
    nominal = np.array([dof.angle for dof in PLACES.responses])
    off = np.rad2deg((PLACES.angles - nominal + np.pi) % (2 * np.pi) - np.pi)
    assert len(PLACES.responses) == ANGLES * len(PLANES)
    assert 0.1 < np.abs(off).max() <= 0.5


def test_accelerance_of_one_doublet() -> None:
    lines = np.array([300.0, 990.0, 1000.0, 1500.0])
    found = accelerance(Ovals(), PLACES, lines)  # type: ignore[arg-type]
    ovals = Ovals()
    u = (
        ovals.motion(PLACES.angles, PLACES.z)[5, 0]
        * ovals.motion(PLACES.hammer_angles, PLACES.hammer_z)[1, 0]
    )
    w = (2 * np.pi * lines) ** 2
    expected = -w * u.sum() / ((2 * np.pi * F0) ** 2 * (1 + 1j * ETA) - w)
    outward = np.sign(PLACES.hammers[1].cylindrical_direction[0])
    assert found[len(PLACES.responses) + 5] == pytest.approx(outward * expected, rel=1e-12)


def test_an_accelerometer_lowers_poles_by_half_its_share_of_the_modal_mass() -> None:
    """δf/f = −m φ²/2, φ² being what both modes of the doublet move the point in the direction that they share."""
    lines = np.arange(985.0, 1005.0, 0.05)
    mass = 0.003
    at_antinode = SimpleNamespace(
        angles=np.array([0.0]), z=np.array([0.0]), hammer_angles=np.array([0.0]), hammer_z=np.array([0.0]),
        responses=PLACES.responses[:1], hammers=PLACES.hammers[:1],
    )  # fmt: skip
    free, loaded = (
        peak_hz(lines, accelerance(Ovals(), at_antinode, lines, Observation(sensor_kg=m))[0])  # type: ignore[arg-type]
        for m in (0.0, mass)
    )
    phi_squared = 2 / MASS * 4 / 5
    assert loaded / free - 1 == pytest.approx(-mass * phi_squared / 2, rel=0.02)


def test_noise_is_a_part_of_the_local_magnitude() -> None:
    lines = np.arange(100.0, 2000.0)
    clean = accelerance(Ovals(), PLACES, lines)  # type: ignore[arg-type]
    noisy = frf_set(clean, PLACES, lines, np.random.default_rng(3)).accelerance
    part = np.abs(noisy - clean) / np.abs(clean)
    strong = np.abs(clean) > 0.1 * np.abs(clean).max()
    assert 0.0025 < np.sqrt(np.mean(part[strong] ** 2)) < 0.0115


def hysteresis(amplitude: float, stiffness: float, limit: float, steps: int = 20000) -> complex:
    """First harmonic of a Jenkins element's force over its motion, by walking through the loop."""
    phase = np.linspace(0, 4 * np.pi, 2 * steps, endpoint=False)
    motion = amplitude * np.cos(phase)
    force, found = 0.0, np.empty(len(motion))
    before = 0.0
    for i, x in enumerate(motion):
        force = float(np.clip(force + stiffness * (x - before), -stiffness * limit, stiffness * limit))
        before, found[i] = x, force
    # x = Re(X e^{iωt}); the second turn is steady
    return complex(2 / steps * np.sum(found[steps:] * np.exp(-1j * phase[steps:])) / amplitude)


@pytest.mark.parametrize("ratio", [0.5, 1.0, 1.5, 4.0])
def test_jenkins_element_against_its_hysteresis(ratio: float) -> None:
    found = jenkins(np.array([ratio * 1e-6]), np.array([2e7]), np.array([1e-6]))[0]
    assert found == pytest.approx(hysteresis(ratio * 1e-6, 2e7, 1e-6), rel=2e-3)


def test_a_contact_that_never_slips_changes_nothing() -> None:
    stiffness = np.array([4e7 * (1 + 0.01j), 0.0])
    squared = np.linspace(1e7, 8e7, 50)
    curves = slipping_curves(stiffness, squared, np.array([1e-3, 1e-3]), np.ones(2), Slip(1e3, 0.1))
    assert curves == pytest.approx(1 / (stiffness[:, None] - squared), rel=1e-9)


def test_more_force_means_softer_and_more_damped() -> None:
    stiffness, squared = np.array([4e7 * (1 + 0.002j)]), np.linspace(3.6e7, 4.2e7, 2000)
    tops = []
    for force in (0.05, 1.0, 100.0):
        curve = np.abs(slipping_curves(stiffness, squared, np.array([force]), np.ones(1), Slip(5.0, 0.1)))[0]
        tops.append((squared[np.argmax(curve)], curve.max()))
    places, heights = zip(*tops, strict=True)
    assert places[0] > places[1] > places[2]
    assert heights[1] < heights[0]
