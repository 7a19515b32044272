"""Harmonic balance of oscillators with a non-linear spring, under a sine of constant force."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.optimize import brentq

Equivalent = Callable[[float], tuple[float, float]]
"""Amplitude (m) → stiffness (N/m) and loss stiffness ωc (N/m)."""


def receptance(axis_hz: np.ndarray, force_n: float, mass_kg: float, equivalent: Equivalent) -> np.ndarray:
    """X/F at constant force: the amplitude solves |k(X) + i h(X) − ω²m| X = F (its lowest solution)."""

    def at(omega: float) -> complex:
        def excess(x: float) -> float:
            k, h = equivalent(x)
            return abs(k + 1j * h - omega**2 * mass_kg) * x - force_n

        trials = np.geomspace(1e-9, 1e-2, 60)
        crossing = next(i for i, x in enumerate(trials) if excess(x) > 0)
        k, h = equivalent(
            float(brentq(excess, trials[crossing - 1] if crossing else 1e-15, trials[crossing]))
        )
        return 1 / (k + 1j * h - omega**2 * mass_kg)

    return np.array([at(2 * np.pi * f) for f in axis_hz])


def duffing(k: float, eta: float, cubic: float) -> Equivalent:
    """k x + cubic x³: k(X) = k + ¾ cubic X²."""
    return lambda x: (k + 0.75 * cubic * x**2, eta * k)


def jenkins(k: float, eta: float, slider: float, slip_n: float) -> Equivalent:
    """A spring beside a Jenkins element of stiffness k_t that slips at μN (physics.md §6)."""
    critical = slip_n / slider

    def equivalent(x: float) -> tuple[float, float]:
        if x <= critical:
            return k + slider, eta * k
        angle = np.arccos(1 - 2 * critical / x)
        stiffness = slider / np.pi * (angle - 0.5 * np.sin(2 * angle))
        loss = 4 * slip_n * (x - critical) / (np.pi * x**2)
        return k + stiffness, eta * k + loss

    return equivalent
