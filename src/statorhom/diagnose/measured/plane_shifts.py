"""Pole shifts from measuring plane to measuring plane, out of every FRF's own pole."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from statorhom.diagnose.measured.measured_test import SHIFT_OWN, PlaneShifts
from statorhom.extraction.extraction import Loaded
from statorhom.extraction.local_poles import local_poles
from statorhom.extraction.measured_modes import MeasuredModes, NamedMode
from statorhom.modes.doublets import DoubletPair

CLOSE = 0.012  # of the frequency: poles nearer than this may be images of one mode
APART = 1.0  # half-power bandwidths by which a mode must stand off all others for its own pole to be told
NARROW = 0.1  # half-power bandwidths between a doublet's modes, below which any point sees one mode, its antinode there
ALIKE = 2.0  # times: the most by which the loss factors of the halves of a doublet differ
LEAST_POINTS = 4  # per plane
LEAST_SD = 5e-6
# the points of a plane may differ by so many standard deviations, or by that part of what the planes differ
CONTRARY, CONTRARY_PART = 8.0, 0.1
UNEXPLAINED = 10.0  # mean squared residual over the noise: a load that leaves more is not known
LARGEST = 0.03  # shifts beyond are of another mode
# half-power bandwidths beyond their spread by which all planes' poles may lie on one side of the mode's own: farther
# off they are a neighbour's
FOREIGN = 0.5
FLANKS = 2.0  # half-power bandwidths
# What a mass alone does not do to a pole, beside `SHIFT_OWN`: a part of the shift; mean square in standard deviations
# from which on something else has moved what looks like the pole.
OWN_PART, NO_SENSOR = 0.1, 5.0


def plane_shifts(measured: MeasuredModes) -> tuple[PlaneShifts, ...]:
    """Shifts of every named mode that is no member of a split doublet, one for all of its images."""
    if measured.extraction.loaded is not None:
        return loaded_shifts(measured, measured.extraction.loaded)
    if len(measured.frf_sets) != 1:
        return ()
    split = [d for d in distinct_doublets(measured) if not _is_narrow(measured.modes, d)]
    paired = {i for d in split for i in (d.lower, d.upper)}
    kept = strongest(measured.modes, paired)
    alone = [
        i
        for i in kept
        if i not in paired
        and measured.modes[i].order is not None
        and stands_off(measured.modes, i, kept)
        and _is_inside(measured.modes[i], measured.extraction.band_hz)
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
        if shifts is not None and _may_be_a_sensors(shifts, one):
            found.append(shifts)
    return tuple(found)


def loaded_shifts(measured: MeasuredModes, loaded: Loaded) -> tuple[PlaneShifts, ...]:
    """Of every named mode of a sensor's load, one for both halves of a doublet: the stronger one's."""
    size, heights, found = _sizes(measured.modes), loaded.load.rings.heights_m, []
    for number, (shift, sd) in enumerate(zip(loaded.shifts, loaded.load.load_sd, strict=True)):
        own = [
            i
            for i, m in enumerate(loaded.mode_of)
            if m == number and measured.modes[i].order == loaded.load.orders[number]
        ]
        if not own or not np.isfinite(sd).all() or loaded.load.misfit[number] > UNEXPLAINED:
            continue
        strongest_half = max(own, key=lambda i: size[i])
        moved = measured.modes[strongest_half].mode.shift
        assert moved is not None
        # the listed frequency is that at the median of the sensor's places
        middle = (
            (1.0 + shift.mean()) * (1.0 + moved[loaded.load.rings.members[0][0], 0].real) / (1.0 + shift[0])
        )
        known = np.maximum(0.5 * sd, LEAST_SD)
        found.append(
            PlaneShifts(str(strongest_half + 1), heights, shift - shift.mean(), known, float(middle - 1.0))
        )
    return tuple(found)


def _is_inside(one: NamedMode, band_hz: tuple[float, float]) -> bool:
    """Whether the recording holds both flanks of the resonance: a single FRF's pole leans on them."""
    low, high = band_hz
    reach = FLANKS * one.mode.bandwidth_hz
    return low + reach < one.mode.frequency_hz < high - reach


def _may_be_a_sensors(shifts: PlaneShifts, one: NamedMode) -> bool:
    """Whether a mass could do this: where the mode moves most its pole is lowest, by the square of how it moves."""
    if one.shape is None or one.order is None or one.name is None or one.name.spectrum is None:
        return True
    along = one.name.spectrum.signed_amplitudes(one.order)
    places = [int(np.argmin(np.abs(one.shape.z_m - z))) for z in shifts.z_m]
    energy = (along[places] / np.nanmax(np.abs(along))) ** 2
    if not np.isfinite(energy).all():
        return True
    weight = 1.0 / (shifts.sd**2 + SHIFT_OWN**2 + (OWN_PART * shifts.shift) ** 2)
    away = energy - float(weight @ energy / weight.sum())
    size = float(weight @ away**2)
    slope = min(0.0, float(weight @ (away * shifts.shift)) / size) if size > 0.0 else 0.0
    rest = shifts.shift - float(weight @ shifts.shift / weight.sum()) - slope * away
    return float(weight @ rest**2) < NO_SENSOR * len(rest)


def _is_narrow(modes: Sequence[NamedMode], doublet: DoubletPair) -> bool:
    lower, upper = (modes[i].mode for i in (doublet.lower, doublet.upper))
    return upper.frequency_hz - lower.frequency_hz < NARROW * lower.bandwidth_hz


def distinct_doublets(measured: MeasuredModes) -> tuple[DoubletPair, ...]:
    """Doublets without weaker images: a sensor that moves a doublet at some planes leaves it twice.

    Nor is a pole of another damping a mode's other half: the peak of a mode that is not linear leaves some beside it.
    """
    modes, size = measured.modes, _sizes(measured.modes)

    def is_image(one: DoubletPair, other: DoubletPair) -> bool:
        mine, its = modes[one.lower], modes[other.lower]
        return (
            (mine.order, mine.axial) == (its.order, its.axial)
            and size[one.lower] + size[one.upper] < size[other.lower] + size[other.upper]
            and _close(mine, its)
        )

    alike = [d for d in measured.doublets if _alike_damped(modes[d.lower], modes[d.upper])]
    return tuple(d for d in alike if not any(is_image(d, e) for e in alike))


def _alike_damped(one: NamedMode, other: NamedMode) -> bool:
    losses = (one.mode.loss_factor, other.mode.loss_factor)
    return max(losses) < ALIKE * min(losses)


def strongest(modes: Sequence[NamedMode], paired: set[int]) -> list[int]:
    """Numbers of the modes without the weaker images of each."""
    size = _sizes(modes)
    kept = []
    for i, one in enumerate(modes):
        close = [
            j
            for j, other in enumerate(modes)
            if j != i
            and size[j] > size[i]
            and _may_be_images(one, other)
            and (one.order is None or other.order == one.order or one.order > 6)
        ]
        if i in paired or not close:
            kept.append(i)
    return kept


def doubtful_axial(modes: Sequence[NamedMode], kept: Sequence[int]) -> set[int]:
    """Numbers of those whose images have other node planes: each image has the planes at which the pole is its own."""

    def is_image(one: NamedMode, other: NamedMode) -> bool:
        return _may_be_images(one, other) and other.order == one.order and other.axial != one.axial

    rest = [mode for j, mode in enumerate(modes) if j not in kept]
    return {i for i in kept if modes[i].order is not None and any(is_image(modes[i], m) for m in rest)}


def _may_be_images(one: NamedMode, other: NamedMode) -> bool:
    """Whether two poles may be one mode's, seen where a sensor moves it by more and by less.

    A sensor moves a mode alike on both sides of the middle, so that images are symmetric along the axis where their
    mode is: (2, 0) and (2, 1) of a short core lie as close together, and are two modes.
    """
    if one.axial is not None and other.axial is not None and (one.axial - other.axial) % 2:
        return False
    return _close(one, other)


def _close(one: NamedMode, other: NamedMode) -> bool:
    return bool(abs(np.log(other.mode.frequency_hz / one.mode.frequency_hz)) < CLOSE)


def _sizes(modes: Sequence[NamedMode]) -> list[float]:
    return [
        float(
            np.linalg.norm(m.mode.participation)
            * np.linalg.norm(np.nan_to_num(m.mode.shape))
            / m.mode.loss_factor
        )
        for m in modes
    ]


def stands_off(modes: Sequence[NamedMode], i: int, kept: Sequence[int]) -> bool:
    """Whether no mode of another name shares the resonance: a single FRF cannot tell which of the two moved.

    Images are left out, for they are the mode itself.
    """
    own = modes[i]
    width = APART * own.mode.loss_factor * own.mode.frequency_hz
    return not any(
        other.order is not None
        and (other.order, other.axial) != (own.order, own.axial)
        and abs(other.mode.frequency_hz - own.mode.frequency_hz) < width
        for other in (modes[j] for j in kept)
    )


def _by_plane(
    label: str, heights: np.ndarray, shift: np.ndarray, sd: np.ndarray, loss: float
) -> PlaneShifts | None:
    """Weighted means around the circumference; their spread tells how certain they are.

    None where the points of a plane contradict each other: then other modes move what looks like the pole.
    """
    usable = np.isfinite(sd) & np.isfinite(heights) & (np.abs(shift) < LARGEST) & (sd < 0.3 * loss)
    planes, means, deviations, scatters, contrary = [], [], [], [], []
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
        scatters.append(float(np.std(shift[here])))
        contrary.append(float(scatters[-1] / np.hypot(np.median(sd[here]), LEAST_SD)))
    if len(planes) < 2:
        return None
    if np.median(contrary) > CONTRARY and np.median(scatters) > CONTRARY_PART * np.ptp(means):
        return None
    s, d = np.array(means), np.array(deviations)
    if np.abs(s).min() > np.ptp(s) + FOREIGN * loss:
        return None
    return PlaneShifts(label, np.array(planes), s - float(s.mean()), d, float(s.mean()))
