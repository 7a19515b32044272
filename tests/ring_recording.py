"""A recording of the ring of `cheap_study`: FRFs of prescribed modes as a universal file."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from statorhom.recordings.recording import Node, Recording
from statorhom.recordings.uff.writer import write_uff
from synthetic_frfs import LENGTH_M, frf_set, ring_points, ring_shape

# order, axial, natural frequency in Hz, loss factor, angle of the antinode in rad
MODES = ((2, 0, 3090.0, 0.004, 0.3), (2, 1, 4590.0, 0.005, 0.3))
SHORTER = 0.06 / LENGTH_M  # the ring's length over that of the prescribed shapes
LINES = np.arange(2600.0, 5200.0, 2.0)


def write_recording(path: Path, modes: tuple[tuple[int, int, float, float, float], ...] = MODES) -> Path:
    """Write the accelerances of 12 × 3 radial sensors and one hammer point."""
    points = ring_points(12, 3)
    shapes = np.array([ring_shape(points, r, angle, n) for r, n, _, _, angle in modes])
    points = [
        replace(p, position=(p.position[0], p.position[1], SHORTER * p.position[2]))
        for p in points
        if p.position
    ]
    poles = [(frequency, loss) for _, _, frequency, loss, _ in modes]
    frfs = frf_set(LINES, points, [0], poles, shapes, noise=0.005)
    nodes = tuple(Node(p.node, p.position) for p in points if p.position is not None)
    write_uff(path, Recording("ring", frf_sets=(frfs,), nodes=nodes))
    return path
