"""What the points of a plate's or a wing's recording tell: shapes, and poles that move from point to point."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from statorhom.diagnose.measured.measured_test import MeasuredPoints
from statorhom.diagnose.measured.plane_shifts import CLOSE, LARGEST
from statorhom.extraction.flat_bodies import is_flat_body
from statorhom.extraction.local_poles import local_poles
from statorhom.extraction.measured_modes import MeasuredModes, NamedMode
from statorhom.modes.mac import mac

RIGID = "rigid body"
SAME_SHAPE = 0.8  # MAC
CERTAIN = 0.3  # of the loss factor: standard deviation of a shift that tells something


def distinct_modes(measured: MeasuredModes) -> tuple[int, ...]:
    """Numbers of the modes that are no motion of the rigid body on its suspension, and no second image of another."""
    kept: list[int] = []
    for i in sorted(range(len(measured.modes)), key=lambda i: -_size(measured.modes[i])):
        one = measured.modes[i]
        rigid = one.plan_form is not None and one.plan_form.kind == RIGID
        if not rigid and not any(_alike(one, measured.modes[j]) for j in kept):
            kept.append(i)
    return tuple(sorted(kept))


def _size(one: NamedMode) -> float:
    """Of its peaks."""
    return float(
        np.linalg.norm(one.mode.participation)
        * np.linalg.norm(np.nan_to_num(one.mode.shape))
        / one.mode.loss_factor
    )


def _alike(one: NamedMode, other: NamedMode) -> bool:
    """Whether two modes have one shape and nearly one frequency."""
    near = abs(np.log(one.mode.frequency_hz / other.mode.frequency_hz)) < CLOSE
    return near and mac(one.mode.shape, other.mode.shape) > SAME_SHAPE


def body_points(measured: MeasuredModes, kept: Sequence[int]) -> MeasuredPoints | None:
    """Motion at the points of a flat body; None for bodies around an axis.

    Parameters
    ----------
    kept : numbers of the modes.
    """
    extraction = measured.extraction
    if not kept or not is_flat_body(extraction.points):
        return None
    shapes = np.array([measured.modes[i].mode.shape for i in kept])
    sd = np.array([measured.modes[i].mode.shape_sd for i in kept])
    placed = np.array([p.position is not None and p.direction is not None for p in extraction.points])
    used = placed & np.isfinite(shapes).all(axis=0)
    points = [p for p, one in zip(extraction.points, used, strict=True) if one]
    shift, shift_sd = (None, None) if extraction.hammer_roved else _shifts(measured, kept)
    return MeasuredPoints(
        np.array([p.position for p in points], dtype=float),
        np.array([p.direction for p in points], dtype=float),
        np.real(shapes[:, used]),
        np.nan_to_num(sd[:, used] / np.sqrt(2.0)),
        None if shift is None else shift[:, used],
        None if shift_sd is None else shift_sd[:, used],
    )


def _shifts(
    measured: MeasuredModes, kept: Sequence[int]
) -> tuple[np.ndarray, np.ndarray] | tuple[None, None]:
    """Of every mode's pole at every point, NaN where it does not show."""
    if len(measured.frf_sets) != 1:
        return None, None
    modes = tuple(replace(measured.modes[i].mode, shift=None) for i in kept)
    extraction = replace(measured.extraction, modes=modes)
    found = local_poles(extraction, measured.frf_sets[0])
    shape = (len(modes), len(extraction.points))
    shift, sd = np.full(shape, np.nan), np.full(shape, np.nan)
    loss = np.array([mode.loss_factor for mode in modes])[:, None]
    clear = (np.abs(found.relative_shift) < LARGEST) & (found.relative_shift_sd < CERTAIN * loss)
    for row, (point, _) in enumerate(extraction.cells):
        here = clear[:, row] & ~(sd[:, point] < found.relative_shift_sd[:, row])
        shift[here, point] = found.relative_shift[here, row]
        sd[here, point] = found.relative_shift_sd[here, row]
    return shift, sd
