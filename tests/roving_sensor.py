"""FRFs of a ring that a roving accelerometer loads, exact: the sensor's inertia force adds to the hammer's."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from statorhom.recordings.dof import Dof
from statorhom.recordings.frf_set import FrfSet
from synthetic_frfs import frf_set, ring_shape

POLES = ((1000.0, 0.004), (1600.0, 0.004))
LINES = np.arange(850.0, 1750.0)
MASS_KG = 0.012


def shapes(points: list[Dof], split: bool = False) -> tuple[list[tuple[float, float]], np.ndarray]:
    """Poles and mass-normalised shapes of two doublets (2, 0) and (2, 1) of a ring of about 2 kg."""
    poles, rows = [], []
    for axial, (frequency, loss) in enumerate(POLES):
        for turn in (0.0, np.pi / 4):
            poles.append((frequency * (1 + 2e-3 * split * (turn > 0)), loss))
            rows.append(ring_shape(points, 2, 0.1 + turn, axial))
    return poles, np.array(rows)


def loaded_frfs(points: list[Dof], mass_kg: float = MASS_KG, noise: float = 0.004) -> FrfSet:
    """x_k = h_kj F + h_kk ω² m x_k for a sensor of mass m at point k; no residual terms."""
    poles, modes = shapes(points)
    bare = frf_set(LINES, points, [0], poles, modes, residuals=(0.0, 0.0))
    squared = (2 * np.pi * LINES) ** 2
    own = np.zeros((len(points), len(LINES)), dtype=complex)
    for (frequency, loss), shape in zip(poles, modes, strict=True):
        own += shape[:, None] ** 2 / ((2 * np.pi * frequency) ** 2 * (1 + 1j * loss) - squared)
    loaded = bare.accelerance / (1 - squared * mass_kg * own)
    rng = np.random.default_rng(3)
    normal = rng.normal(size=(2, *loaded.shape)) / np.sqrt(2)
    sd = np.hypot(noise * np.abs(loaded), 3e-4 * np.abs(loaded).max())
    return replace(bare, accelerance=loaded + sd * (normal[0] + 1j * normal[1]))
