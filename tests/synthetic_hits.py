"""Hits on a structure whose receptance is known exactly.

Modal superposition, each mode by its first-order-hold filter: exact for a force that is linear between samples,
which eight times the recorder's sample rate makes indistinguishable from the smooth pulse.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy import optimize, signal

from statorhom.recordings.dof import Dof
from statorhom.recordings.estimation.sweep_plan import SweepStage, sweep_signal
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


def recorded(fine: np.ndarray) -> np.ndarray:
    """What a recorder with an anti-aliasing filter, alike in all channels, makes of the signals."""
    taps = 20 * OVERSAMPLING + 1
    low_pass = signal.firwin(taps, 0.82 / OVERSAMPLING)
    padded = np.pad(fine, ((0, 0), (taps // 2, taps // 2)))
    return signal.upfirdn(low_pass, padded, 1, OVERSAMPLING, axis=1)[
        :, 20 : 20 + fine.shape[1] // OVERSAMPLING
    ]


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
    records = recorded(np.vstack([force, accelerations(force, fine, damping)]))
    size = noise * np.abs(records).max(axis=1, keepdims=True)
    records = records + size * rng.standard_normal(records.shape)
    return Hit(number, RATE_HZ, records[0], records[1:], REFERENCE, responses, "synthetic")


def damping_ratio(frequency_hz: np.ndarray, values: np.ndarray, near_hz: float) -> float:
    """Damping ratio of the mode near a frequency: least squares of one pole and a line, none of the program's own."""
    band = np.abs(frequency_hz - near_hz) < 0.02 * near_hz
    offset, measured = frequency_hz[band] - near_hz, values[band]

    def residual(pole: np.ndarray) -> np.ndarray:
        columns = np.column_stack([1 / (offset - complex(*pole)), np.ones_like(offset), offset])
        rest = measured - columns @ np.linalg.lstsq(columns, measured, rcond=None)[0]
        return np.concatenate([rest.real, rest.imag])

    real, imaginary = optimize.least_squares(residual, [0.0, 0.005 * near_hz], x_scale=[1.0, 1.0]).x
    return float(imaginary / np.hypot(near_hz + real, imaginary))


def sweep(stages: Sequence[SweepStage], *, noise: float = 0.0, seed: int = 0) -> Hit:
    """A recorded sine sweep: noise is a fraction of each channel's rms value."""
    fine = RATE_HZ * OVERSAMPLING
    quiet = np.zeros(round(0.5 * fine))
    force = np.concatenate([quiet, sweep_signal(stages, fine), quiet, quiet])
    records = recorded(np.vstack([force, accelerations(force, fine)]))
    size = noise * records.std(axis=1, keepdims=True)
    records = records + size * np.random.default_rng(seed).standard_normal(records.shape)
    return Hit(1, RATE_HZ, records[0], records[1:], REFERENCE, RESPONSES, "synthetic")
