"""One mode in the place of both halves of a doublet that a roving sensor moves alike.

The sensor turns a doublet until its antinode is at the sensor, so that its motion is that of both halves together; what
one hammer sees of them is the sum of their residues.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import numpy.typing as npt

from statorhom.extraction.extraction import ExtractedMode, Loaded

ComplexArray = npt.NDArray[np.complex128]
Partners = dict[int, tuple[int, float]]


def whole_doublets(modes: Sequence[ExtractedMode], loaded: Loaded) -> tuple[list[ExtractedMode], Partners]:
    """The modes with every doublet's stronger half as the whole of it, as the sensor shows it, the weaker one at rest.

    Returns
    -------
    modes, partners
        Number of a weaker half → that of the stronger one, and the ratio of their frequencies.
    """
    found, partners = list(modes), Partners()
    halves = [[i for i, m in enumerate(loaded.mode_of) if m == number] for number in range(len(loaded.load))]
    free = np.array([_residues(modes, one, len(loaded.load.rings.plane)) for one in halves])
    for number, own in enumerate(halves):
        if not own:
            continue
        strongest = max(own, key=lambda i: abs(modes[i].participation[0]))
        found[strongest] = _whole(
            [modes[i] for i in own], modes[strongest], _under_sensor(free, loaded, number)
        )
        for i in set(own) - {strongest}:
            found[i] = replace(modes[i], shift=None)
            partners[i] = strongest, modes[i].frequency_hz / modes[strongest].frequency_hz
    return found, partners


def _residues(modes: Sequence[ExtractedMode], halves: Sequence[int], points: int) -> ComplexArray:
    """Of both halves together, at the first reference, shape (points,)."""
    none = np.zeros(points, dtype=complex)
    return np.sum([none, *(modes[i].shape * modes[i].participation[0] for i in halves)], axis=0)


def _under_sensor(free: ComplexArray, loaded: Loaded, number: int) -> ComplexArray:
    """Residues of the moved pole at every point, to which modes nearby add: −N/D' of N/D with D = 0."""
    load, plane = loaded.load, loaded.load.rings.plane
    place = load.poles[number] * (1 + loaded.shifts[number]) ** 2
    apart = load.poles[:, None] - place
    slope = -np.sum(load.load * load.poles[:, None] / apart**2, axis=0)
    moved: ComplexArray = -np.sum(free / apart[:, plane], axis=0) / slope[plane]
    return moved


def _whole(halves: Sequence[ExtractedMode], one: ExtractedMode, residues: ComplexArray) -> ExtractedMode:
    sd = np.linalg.norm([half.shape_sd * abs(half.participation[0]) for half in halves], axis=0)
    phase = np.exp(0.5j * np.angle(np.sum(residues**2)))
    size = float(np.max(np.abs(residues))) or 1.0
    participation = one.participation.copy()
    participation[0] = size * phase
    return replace(one, shape=residues / phase / size, shape_sd=sd / size, participation=participation)
