"""Accelerances of a true stator: superposed modes, the roving accelerometer's own mass, noise."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from statorhom.conceal.friction import slipping_curves
from statorhom.conceal.ritz import RitzModes
from statorhom.conceal.sensors import Sensors
from statorhom.conceal.truth import Slip
from statorhom.recordings.frf_set import FrfSet

LOWEST_HZ = 100.0
STEP_HZ = 1.0
NOISE = (0.003, 0.010)  # of the local magnitude
FLOOR_DB = -70.0  # below the largest value
BLOCK = 512  # lines at a time


def frequency_lines(highest_hz: float) -> np.ndarray:
    """The recording's frequency axis (Hz)."""
    return np.arange(LOWEST_HZ, highest_hz + STEP_HZ / 2, STEP_HZ)


@dataclass(frozen=True)
class Observation:
    """What the way of measuring does to the recording.

    Parameters
    ----------
    sensor_kg : of the roving accelerometer.
    slip : of a contact; None where it sticks.
    force_n : amplitude of the force, which matters where a contact slips.
    """

    sensor_kg: float = 0.0
    slip: Slip | None = None
    force_n: float = 1.0


def accelerance(
    ritz: RitzModes, sensors: Sensors, lines_hz: np.ndarray, observation: Observation | None = None
) -> np.ndarray:
    """Noise-free accelerances (hammers p, lines), the hammers slowest.

    H(ω) = Σ φ φᵀ/(λ(1 + iη) − ω²) over all Ritz modes: rigid bodies are the low, modes above the band and the static
    response the high residual. An accelerometer of mass m at a point loads it in three directions,
    H' = (I − ω² m H_kk)⁻¹ H_kj, so that poles differ from point to point.

    Parameters
    ----------
    ritz : modes of the test.
    sensors : its points.
    lines_hz : (lines,) Hz.
    observation : with which effects; none by default.
    """
    how = observation or Observation()
    motion = ritz.motion(sensors.angles, sensors.z)
    hits = ritz.motion(sensors.hammer_angles, sensors.hammer_z)[:, 0]
    signs = np.array([np.sign(_outward(d.cylindrical_direction)) for d in sensors.hammers])
    stiffness = ritz.eigenvalues * (1 + 1j * ritz.loss_factors)
    found = np.empty((len(hits), len(motion), len(lines_hz)), dtype=complex)
    for first in range(0, len(lines_hz), BLOCK):
        part = slice(first, first + BLOCK)
        squared = (2 * np.pi * lines_hz[part]) ** 2
        for number, hit in enumerate(hits):
            curves = 1 / (stiffness[:, None] - squared)
            if how.slip is not None:
                contact = np.sqrt(np.mean(motion[:, 0] ** 2, axis=0))
                curves = slipping_curves(stiffness, squared, how.force_n * hit, contact, how.slip)
            found[number, :, part] = -squared * _receptance(motion, hit, curves, squared, how.sensor_kg)
    return (signs[:, None, None] * found).reshape(-1, len(lines_hz))


def _receptance(
    motion: np.ndarray, hit: np.ndarray, curves: np.ndarray, squared: np.ndarray, sensor_kg: float
) -> np.ndarray:
    """(p, lines) of the radial direction."""
    if sensor_kg == 0.0:
        return np.asarray((motion[:, 0] * hit) @ curves)
    found = np.empty((len(motion), len(squared)), dtype=complex)
    for point, phi in enumerate(motion):
        pairs = (phi[:, None, :] * phi[None, :, :]).reshape(9, -1) @ curves
        own = np.moveaxis(pairs.reshape(3, 3, -1), -1, 0)
        loaded = np.eye(3) - sensor_kg * squared[:, None, None] * own
        cross = ((phi * hit) @ curves).T[:, :, None]
        found[point] = np.linalg.solve(loaded, cross)[:, 0, 0]
    return found


def _outward(direction: tuple[float, float, float] | None) -> float:
    assert direction is not None, "the points have positions and directions"
    return direction[0]


def frf_set(clean: np.ndarray, sensors: Sensors, lines_hz: np.ndarray, rng: np.random.Generator) -> FrfSet:
    """The recording: noise of a part of the local magnitude, and a floor."""
    level = rng.uniform(*NOISE)
    floor = np.abs(clean).max() * 10 ** (FLOOR_DB / 20)
    sd = np.hypot(level * np.abs(clean), floor)
    noise = rng.standard_normal((2, *clean.shape)) / np.sqrt(2)
    hits, points = len(sensors.hammers), len(sensors.responses)
    return FrfSet(
        lines_hz,
        sensors.responses * hits,
        tuple(sensors.hammers[i // points] for i in range(hits * points)),
        clean + sd * (noise[0] + 1j * noise[1]),
    )
