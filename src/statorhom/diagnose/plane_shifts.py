"""Pole shifts from measuring plane to measuring plane, out of every FRF's own pole."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from statorhom.diagnose.measured import PlaneShifts
from statorhom.extraction.local_poles import local_poles
from statorhom.extraction.measured_modes import MeasuredModes, NamedMode

CLOSE = 0.012  # of the frequency: poles nearer than this may be images of one mode
APART = 1.0  # half-power bandwidths by which a mode must stand off all others for its own pole to be told
ALIKE = 0.5  # rad: antinodes of images lie together, those of a doublet's two modes apart
LEAST_POINTS = 4  # per plane
LEAST_SD = 5e-6
CONTRARY = 8.0  # standard deviations by which the points of a plane may differ
LARGEST = 0.03  # shifts beyond are of another mode


def plane_shifts(measured: MeasuredModes) -> tuple[PlaneShifts, ...]:
    """Shifts of every named mode that is no member of a doublet, one for all of its images."""
    if len(measured.frf_sets) != 1:
        return ()
    paired = {i for d in measured.doublets for i in (d.lower, d.upper)}
    kept = strongest(measured.modes, paired)
    alone = [
        i
        for i in kept
        if i not in paired and measured.modes[i].order is not None and stands_off(measured.modes, i)
    ]
    if not alone:
        return ()
    extraction = replace(
        measured.extraction,
        modes=tuple(replace(measured.modes[i].mode, shift=None) for i in kept),
    )
    poles = local_poles(extraction, measured.frf_sets[0])
    places = [dof.position for dof in measured.frf_sets[0].responses]
    heights = np.array([np.nan if p is None else p[2] for p in places])
    found = []
    for i in alone:
        row = kept.index(i)
        one = measured.modes[i]
        label = str(i + 1)
        shifts = _by_plane(
            label, heights, poles.relative_shift[row], poles.relative_shift_sd[row], one.mode.loss_factor
        )
        if shifts is not None:
            found.append(shifts)
    return tuple(found)


def strongest(modes: Sequence[NamedMode], paired: set[int]) -> list[int]:
    """Numbers of the modes without the weaker images of each."""
    size = [
        float(
            np.linalg.norm(m.mode.participation)
            * np.linalg.norm(np.nan_to_num(m.mode.shape))
            / m.mode.loss_factor
        )
        for m in modes
    ]
    kept = []
    for i, one in enumerate(modes):
        close = [
            j
            for j, other in enumerate(modes)
            if j != i
            and size[j] > size[i]
            and abs(np.log(other.mode.frequency_hz / one.mode.frequency_hz)) < CLOSE
            and (one.order is None or other.order == one.order or one.order > 6)
        ]
        if i in paired or not close:
            kept.append(i)
    return kept


def stands_off(modes: Sequence[NamedMode], i: int) -> bool:
    """Whether no mode of another name shares the resonance: a single FRF cannot tell which of the two moved."""
    own = modes[i]
    width = APART * own.mode.loss_factor * own.mode.frequency_hz
    return not any(
        other.order is not None
        and (other.order, other.axial) != (own.order, own.axial)
        and abs(other.mode.frequency_hz - own.mode.frequency_hz) < width
        for other in modes
    )


def _by_plane(
    label: str, heights: np.ndarray, shift: np.ndarray, sd: np.ndarray, loss: float
) -> PlaneShifts | None:
    """Weighted means around the circumference; their spread tells how certain they are.

    None where the points of a plane contradict each other: then other modes move what looks like the pole.
    """
    usable = np.isfinite(sd) & np.isfinite(heights) & (np.abs(shift) < LARGEST) & (sd < 0.3 * loss)
    planes, means, deviations, contrary = [], [], [], []
    for z in np.unique(np.round(heights[np.isfinite(heights)], 6)):
        here = usable & (np.abs(heights - z) < 1e-6)
        if np.count_nonzero(here) < LEAST_POINTS:
            continue
        middle = float(np.median(shift[here]))
        weight = 1 / (sd[here] ** 2 + np.median(np.abs(shift[here] - middle)) ** 2 + LEAST_SD**2)
        mean = float(weight @ shift[here] / weight.sum())
        spread = float(np.sqrt(weight @ (shift[here] - mean) ** 2 / weight.sum() / np.count_nonzero(here)))
        planes.append(float(z))
        means.append(mean)
        deviations.append(max(spread, LEAST_SD))
        contrary.append(float(np.std(shift[here]) / np.hypot(np.median(sd[here]), LEAST_SD)))
    if len(planes) < 2 or np.median(contrary) > CONTRARY:
        return None
    s, d = np.array(means), np.array(deviations)
    return PlaneShifts(label, np.array(planes), s - float(s.mean()), d, float(s.mean()))
