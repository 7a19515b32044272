"""FRFs of systems whose modes are prescribed, exact or with noise of a prescribed level."""

from __future__ import annotations

import numpy as np

from statorhom.recordings.dof import Dof
from statorhom.recordings.frf_set import FrfSet

LENGTH_M, RADIUS_M = 0.08, 0.06


def ring_points(angles: int, planes: int) -> list[Dof]:
    """Radial degrees of freedom on a cylinder, plane after plane."""
    points = []
    for plane in range(planes):
        z = LENGTH_M * (plane + 0.5) / planes
        for i in range(angles):
            theta = 2 * np.pi * i / angles
            x, y = float(np.cos(theta)), float(np.sin(theta))
            node = 100 * (plane + 1) + i + 1
            points.append(Dof(node, (RADIUS_M * x, RADIUS_M * y, z), (x, y, 0.0)))
    return points


def ring_shape(points: list[Dof], order: int, angle: float, axial: int = 0) -> np.ndarray:
    """cos r(θ − α), with n node planes along z."""
    theta = np.array([point.angle for point in points], dtype=float)
    z = np.array([point.position[2] for point in points if point.position is not None])
    return np.cos(order * (theta - angle)) * np.cos(axial * np.pi * z / LENGTH_M)


def frf_set(
    frequency_hz: np.ndarray,
    points: list[Dof],
    reference_rows: list[int],
    poles: list[tuple[float, float]],
    shapes: np.ndarray,
    *,
    noise: float = 0.0,
    floor_db: float = -70.0,
    seed: int = 0,
    residuals: tuple[float, float] = (-0.3, 2e-9),
    decay_per_s: float = 0.0,
) -> FrfSet:
    """Accelerances of Σ φ_k φ_j/(ω_r²(1 + iη_r) − ω²) + −1/(Mω²) + 1/K, poles given as (f_r, η_r)."""
    squared = (2 * np.pi * frequency_hz) ** 2
    receptance = np.zeros((len(points) * len(reference_rows), len(frequency_hz)), dtype=complex)
    for (frequency, loss), shape in zip(poles, shapes, strict=True):
        square = (2 * np.pi * frequency) ** 2
        curve = 1.0 / (square * (1 + 1j * (loss + 2 * decay_per_s / np.sqrt(square))) - squared)
        residue = np.concatenate([shape * shape[j] for j in reference_rows])
        receptance += residue[:, None] * curve
    receptance += residuals[0] / squared + residuals[1]
    accelerance = -receptance * squared
    if noise:
        rng = np.random.default_rng(seed)
        floor = np.abs(accelerance).max() * 10 ** (floor_db / 20)
        sd = np.hypot(noise * np.abs(accelerance), floor)
        normal = rng.normal(size=(2, *accelerance.shape)) / np.sqrt(2)
        accelerance = accelerance + sd * (normal[0] + 1j * normal[1])
    return FrfSet(
        frequency_hz,
        tuple(points) * len(reference_rows),
        tuple(points[j] for j in reference_rows for _ in points),
        accelerance,
        window_decay_per_s=decay_per_s,
    )
