"""Synthetic mode shapes of known order and node planes."""

from __future__ import annotations

import numpy as np

PLANES_M = 0.08 * np.array([0.05, 0.35, 0.65, 0.95])


def equidistant(count: int) -> np.ndarray:
    return 2 * np.pi * np.arange(count) / count


def shape(order, axial, angles_rad, *, z_m=PLANES_M, phase_rad=0.4, factor=1.0):
    """factor · cos(axial · π z / L) · cos(order · θ − phase), the core 0.08 m long."""
    along = np.cos(axial * np.pi * np.asarray(z_m) / 0.08)
    around = np.cos(order * np.asarray(angles_rad) - (phase_rad if order else 0.0))
    return factor * np.outer(along, around)
