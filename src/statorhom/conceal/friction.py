"""A contact that slips, by harmonic balance mode by mode: Jenkins element (Jenkins 1962; Gaul & Nitsche 2001)."""

from __future__ import annotations

import numpy as np

from statorhom.conceal.truth import Slip

ROUNDS = 200
RELAXATION = 0.5
CLOSE = 1e-8


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
    force = np.abs(forces)[:, None]
    own = np.broadcast_to(carried.astype(complex), (len(stiffness), len(squared)))
    for _ in range(ROUNDS):
        amplitude = force / np.abs(rest + own - squared)
        new = np.where(np.isfinite(limit), jenkins(amplitude, carried, limit), carried)
        step = np.abs(new - own).max(initial=0.0)
        own = own + RELAXATION * (new - own)
        if step <= CLOSE * np.abs(carried).max(initial=0.0):
            break
    return np.asarray(1 / (rest + own - squared))
