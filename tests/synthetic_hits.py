"""Hits on a structure whose receptance is known exactly.

Modal superposition, each mode by its first-order-hold filter: exact for a force that is linear between samples,
which eight times the recorder's sample rate makes indistinguishable from the smooth pulse.
"""

from __future__ import annotations

import numpy as np
from scipy import signal

from statorhom.recordings.dof import Dof
from statorhom.recordings.hit import Hit

RATE_HZ = 12800.0
OVERSAMPLING = 8
FREQUENCIES_HZ = np.array([612.0, 1432.0, 2650.0])
DAMPING = np.array([0.004, 0.003, 0.006])
CONSTANTS = np.array([[0.56, 0.30, 0.20], [0.40, -0.35, 0.25]])  # 1/kg, of two responses
REFERENCE = Dof(901, (0.06, 0.0, 0.0), (1.0, 0.0, 0.0))
RESPONSES = (Dof(101, (0.06, 0.0, 0.02), (1.0, 0.0, 0.0)), Dof(102, (0.0, 0.06, 0.02), (0.0, 1.0, 0.0)))


def receptance(frequency_hz: np.ndarray, shift_per_s: float = 0.0) -> np.ndarray:
    """Exact receptances of the two responses at iω + shift, shape (2, lines)."""
    s = 2j * np.pi * frequency_hz + shift_per_s
    natural = 2 * np.pi * FREQUENCIES_HZ
    denominator = s[:, None] ** 2 + 2 * DAMPING * natural * s[:, None] + natural**2
    return CONSTANTS @ (1 / denominator).T


def accelerance(frequency_hz: np.ndarray, shift_per_s: float = 0.0) -> np.ndarray:
    return receptance(frequency_hz, shift_per_s) * (2j * np.pi * frequency_hz + shift_per_s) ** 2


def accelerations(force: np.ndarray, rate_hz: float, damping: np.ndarray = DAMPING) -> np.ndarray:
    """Responses to a force that is linear between samples, shape (2, samples)."""
    modal = []
    for frequency, ratio in zip(FREQUENCIES_HZ, damping, strict=True):
        natural = 2 * np.pi * frequency
        continuous = ([1.0, 0.0, 0.0], [1.0, 2 * ratio * natural, natural**2])
        numerator, denominator, _ = signal.cont2discrete(continuous, 1 / rate_hz, method="foh")
        modal.append(signal.lfilter(np.ravel(numerator), denominator, force))
    return CONSTANTS @ np.array(modal)


def pulse(time: np.ndarray, start_s: float, width_s: float) -> np.ndarray:
    """Haversine of height one."""
    phase = np.clip((time - start_s) / width_s, 0.0, 1.0)
    return 0.5 - 0.5 * np.cos(2 * np.pi * phase)


def hit(
    number: int = 1,
    *,
    seed: int = 0,
    noise: float = 0.03,
    duration_s: float = 1.0,
    pulses: tuple[tuple[float, float], ...] = ((0.02, 100.0),),
    width_s: float = 4e-4,
    damping: np.ndarray = DAMPING,
    responses: tuple[Dof, ...] = RESPONSES,
) -> Hit:
    """A recorded hit: noise is a fraction of each channel's largest value, pulses are (seconds, newtons)."""
    rng = np.random.default_rng((seed, number))
    fine = RATE_HZ * OVERSAMPLING
    time = np.arange(round(duration_s * RATE_HZ) * OVERSAMPLING) / fine
    jitter = rng.uniform(0, 1 / RATE_HZ)
    force = sum(height * pulse(time, start + jitter, width_s) for start, height in pulses)
    records = np.vstack([force, accelerations(force, fine, damping)])[:, ::OVERSAMPLING]
    size = noise * np.abs(records).max(axis=1, keepdims=True)
    records = records + size * rng.standard_normal(records.shape)
    return Hit(number, RATE_HZ, records[0], records[1:], REFERENCE, responses, "synthetic")


def damping_ratio(frequency_hz: np.ndarray, values: np.ndarray, near_hz: float) -> float:
    """Damping ratio of the mode near a frequency, by a local rational fit; independent of the program's own.

    H·d(s) = n(s) with quadratic d and n over a narrow band, weighted by the last denominator (Sanathanan-Koerner).
    """
    band = np.abs(frequency_hz - near_hz) < 0.02 * near_hz
    s = 1j * (frequency_hz[band] - near_hz)
    weight = np.ones(len(s))
    for _ in range(20):
        columns = np.column_stack([values[band], -np.ones_like(s), -s, -(s**2)]) * weight[:, None]
        target = -s * values[band] * weight
        stacked = np.vstack([columns.real, columns.imag]), np.concatenate([target.real, target.imag])
        # the pole is complex in this shifted plane, so all unknowns are
        unknowns = np.linalg.lstsq(columns, target, rcond=None)[0]
        weight = 1 / np.abs(s + unknowns[0])
    del stacked
    pole = 2 * np.pi * (-unknowns[0] + 1j * near_hz)
    return float(-pole.real / abs(pole))
