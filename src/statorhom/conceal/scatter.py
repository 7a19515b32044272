"""Manufacturing scatter: the lamination's stiffness is never quite the same around the stator."""

from __future__ import annotations

from typing import Any

import numpy as np

from statorhom.conceal.breaks import Wave

HARMONICS = (2, 10)  # first, and the one after the last
COUNT = 3
LEAST, MOST = 0.0005, 0.002


def scatter(rng: np.random.Generator) -> tuple[Wave, ...]:
    """Three weak waves of random harmonics and phases."""
    return tuple(
        Wave(int(rng.integers(*HARMONICS)), float(rng.uniform(LEAST, MOST)), float(rng.uniform(0, 2 * np.pi)))
        for _ in range(COUNT)
    )


def scatter_json(waves: tuple[Wave, ...]) -> list[dict[str, Any]]:
    """As truth.json states it; the phase is that of cos(n θ − phase)."""
    return [
        {"harmonic": w.harmonic, "relative": w.amplitude, "phase_rad": w.harmonic * w.angle % (2 * np.pi)}
        for w in waves
    ]
