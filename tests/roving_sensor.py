"""FRFs of a ring that a roving accelerometer loads, exact: the sensor's inertia forces add to the hammer's.

The sensor's mass is moved in all directions; what it measures is the radial motion alone.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from statorhom.recordings.dof import Dof
from statorhom.recordings.frf_set import FrfSet
from synthetic_frfs import LENGTH_M, RADIUS_M, frf_set, ring_shape

POLES = ((1000.0, 0.004), (1600.0, 0.004))
LINES = np.arange(850.0, 1750.0)
MASS_KG = 0.012
YOKE_M = 0.011


def shapes(points: list[Dof], split: bool = False) -> tuple[list[tuple[float, float]], np.ndarray]:
    """Poles and mass-normalised radial shapes of two doublets (2, 0) and (2, 1) of a ring of about 2 kg."""
    poles, rows = [], []
    for axial, (frequency, loss) in enumerate(POLES):
        for turn in (0.0, np.pi / 4):
            poles.append((frequency * (1 + 2e-3 * split * (turn > 0)), loss))
            rows.append(ring_shape(points, 2, 0.1 + turn, axial))
    return poles, np.array(rows)


def directions(points: list[Dof]) -> np.ndarray:
    """Radial, tangential and axial shapes, (modes, points, 3): a yoke that bends without stretching or shear."""
    theta = np.array([point.angle for point in points], dtype=float)
    z = np.array([point.position[2] for point in points if point.position is not None])
    lever = (RADIUS_M - YOKE_M / 2) / 4 + YOKE_M / 2
    rows = []
    for axial in range(len(POLES)):
        along = np.cos(axial * np.pi * z / LENGTH_M)
        slope = -axial * np.pi / LENGTH_M * np.sin(axial * np.pi * z / LENGTH_M)
        for turn in (0.0, np.pi / 4):
            phase = 2 * (theta - 0.1 - turn)
            around = np.cos(phase)
            rows.append(
                np.stack([along * around, -along * np.sin(phase) / 2, -lever * slope * around], axis=1)
            )
    return np.array(rows)


def loaded_frfs(points: list[Dof], mass_kg: float = MASS_KG, noise: float = 0.004) -> FrfSet:
    """x_k = h_kj F + H_kk ω² m x_k for a sensor of mass m at point k, x_k in three directions; no residual terms."""
    poles, modes = shapes(points)
    bare = frf_set(LINES, points, [0], poles, modes, residuals=(0.0, 0.0))
    loaded = loaded_accelerance(LINES, poles, directions(points), modes[:, 0], mass_kg)
    rng = np.random.default_rng(3)
    normal = rng.normal(size=(2, *loaded.shape)) / np.sqrt(2)
    sd = np.hypot(noise * np.abs(loaded), 3e-4 * np.abs(loaded).max())
    return replace(bare, accelerance=loaded + sd * (normal[0] + 1j * normal[1]))


def loaded_accelerance(
    lines: np.ndarray, poles: list[tuple[float, float]], moved: np.ndarray, hammer: np.ndarray, mass_kg: float
) -> np.ndarray:
    """(points, lines) at a sensor that is moved in all directions; what it measures is the first one.

    Parameters
    ----------
    moved : (modes, points, 3) shapes of unit modal mass.
    hammer : (modes,) of the hammer's point, in its direction.
    """
    squared = (2 * np.pi * lines) ** 2
    curves = np.array([1 / ((2 * np.pi * f) ** 2 * (1 + 1j * loss) - squared) for f, loss in poles])
    force = np.einsum("mkd,m,ml->kld", moved, hammer, curves)
    own = np.einsum("mkd,mke,ml->klde", moved, moved, curves)
    motion = np.linalg.solve(np.eye(3) - mass_kg * squared[:, None, None] * own, force[..., None])
    return np.asarray(-squared * motion[..., 0, 0])


def loaded_from_hammers(
    lines: np.ndarray,
    points: list[Dof],
    hammers: tuple[int, ...],
    poles: list[tuple[float, float]],
    radial: np.ndarray,
    moved: np.ndarray,
    noise: tuple[float, float],
    mass_kg: float = MASS_KG,
) -> FrfSet:
    """FRFs of all points from several hammers' points, as `loaded_accelerance` has them.

    Parameters
    ----------
    radial : (modes, points) of unit modal mass.
    noise : of each value's magnitude, and of the largest one.
    """
    values = np.concatenate([loaded_accelerance(lines, poles, moved, radial[:, h], mass_kg) for h in hammers])
    normal = np.random.default_rng(4).normal(size=(2, *values.shape)) / np.sqrt(2)
    sd = np.hypot(noise[0] * np.abs(values), noise[1] * np.abs(values).max())
    references = tuple(points[h] for h in hammers for _ in points)
    return FrfSet(lines, tuple(points) * len(hammers), references, values + sd * (normal[0] + 1j * normal[1]))
