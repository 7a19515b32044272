"""Synthetic measurements of cylinders: degrees of freedom and the shapes that sensors would see there."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from statorhom.recordings.dof import Dof

Z_M = (0.004, 0.028, 0.052, 0.076)


def dof(node: int, angle: float, z: float, radius: float = 0.06, component: str = "r") -> Dof:
    """A degree of freedom on a cylinder; component r, t, z, x or y."""
    c, s = np.cos(angle), np.sin(angle)
    direction = {"r": (c, s, 0.0), "t": (-s, c, 0.0), "z": (0, 0, 1.0), "x": (1.0, 0, 0), "y": (0, 1.0, 0)}
    x, y, up = (float(value) for value in direction[component])
    return Dof(node, (float(radius * c), float(radius * s), float(z)), (x, y, up))


def cylinder(
    angles: Sequence[float] | np.ndarray,
    z_m: Sequence[float] = Z_M,
    radius: float = 0.06,
    component: str = "r",
) -> list[Dof]:
    """Points plane after plane."""
    return [
        dof(i * len(angles) + j, angle, z, radius, component)
        for i, z in enumerate(z_m)
        for j, angle in enumerate(angles)
    ]


def radial_values(dofs: Sequence[Dof], motion) -> np.ndarray:
    """What radial sensors see of a motion(θ, z)."""
    return np.array([motion(d.angle, d.position[2]) for d in dofs], dtype=complex)


def complex_noise(rng: np.random.Generator, shape, sd: float) -> np.ndarray:
    """Noise whose root mean square modulus is sd."""
    return sd / np.sqrt(2) * (rng.standard_normal(shape) + 1j * rng.standard_normal(shape))
