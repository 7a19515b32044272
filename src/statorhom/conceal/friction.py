"""A contact that slips, by harmonic balance mode by mode: Jenkins element (Jenkins 1962; Gaul & Nitsche 2001)."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from statorhom.conceal.truth import Slip

SCAN, REACH = 120, 1e4  # amplitudes that are tried, up to so many times the limit of sticking
ROUNDS = 40


def jenkins(amplitude: np.ndarray, stiffness: np.ndarray, slip: np.ndarray) -> np.ndarray:
    """Complex equivalent stiffness of a Jenkins element.

    Parameters
    ----------
    amplitude : of the motion across it.
    stiffness : k_t, while it sticks.
    slip : x_c = μN/k_t, amplitude at which it begins to slip.
    """
    ratio = np.minimum(slip / np.maximum(amplitude, np.finfo(float).tiny), 1.0)
    angle = np.arccos(1 - 2 * ratio)
    real = (angle - 0.5 * np.sin(2 * angle)) / np.pi
    # ΔE/(π X²) with ΔE = 4 μN (X − x_c)
    imaginary = 4 / np.pi * ratio * (1 - ratio)
    return np.asarray(stiffness * (real + 1j * imaginary))


def slipping_curves(
    stiffness: np.ndarray, squared: np.ndarray, forces: np.ndarray, contact: np.ndarray, slip: Slip
) -> np.ndarray:
    """1/(λ(1 + iη) − ω²) of modes whose stiffness falls with their amplitude, (m, lines).

    Parameters
    ----------
    stiffness : (m,) λ(1 + iη) while the contact sticks; modes of zero stiffness have none.
    squared : (lines,) ω².
    forces : (m,) modal forces.
    contact : (m,) motion at the contact of a unit modal coordinate.
    slip : of the contact.
    """
    carried = slip.share * stiffness.real[:, None]
    rest = stiffness[:, None] - carried
    with np.errstate(divide="ignore", invalid="ignore"):
        limit = np.where(carried > 0, slip.force_n * np.abs(contact[:, None]) / carried, np.inf)
    force = np.broadcast_to(np.abs(forces)[:, None], (len(stiffness), len(squared)))

    def stiff(amplitude: np.ndarray) -> np.ndarray:
        slipping = amplitude > limit
        return np.asarray(
            np.where(slipping, jenkins(amplitude, carried, np.minimum(limit, amplitude)), carried)
        )

    def excess(amplitude: np.ndarray) -> np.ndarray:
        return np.asarray(amplitude * np.abs(rest + stiff(amplitude) - squared) - force)

    stuck = force / np.abs(stiffness[:, None] - squared)
    amplitude = np.where(stuck <= limit, stuck, _first_root(excess, limit, stuck))
    return np.asarray(1 / (rest + stiff(amplitude) - squared))


def _first_root(
    excess: Callable[[np.ndarray], np.ndarray], limit: np.ndarray, stuck: np.ndarray
) -> np.ndarray:
    """Smallest amplitude beyond the limit of sticking at which the forces balance: that of a force that grows."""
    finite = np.where(np.isfinite(limit), limit, stuck)
    low, high = np.broadcast_to(finite, stuck.shape).copy(), np.full(stuck.shape, np.nan)
    for factor in np.geomspace(1.0, REACH, SCAN)[1:]:
        trial = finite * factor
        above = np.isnan(high) & (excess(trial) >= 0)
        high = np.where(above, trial, high)
        low = np.where(np.isnan(high), trial, low)
    high = np.where(np.isnan(high), low, high)
    for _ in range(ROUNDS):
        middle = 0.5 * (low + high)
        over = excess(middle) >= 0
        high, low = np.where(over, middle, high), np.where(over, low, middle)
    return 0.5 * (low + high)
