"""Measured against predicted, in standard deviations: frequencies, doublet splits, pole shifts along the axis.

Two things are in every measurement and no left-out physics: the mesh's error, which all modes of a stage share (a
coordinate of the constants) or have by themselves, and a lamination that differs a little around the stator.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from math import copysign, hypot, log, sqrt
from typing import NamedTuple

import numpy as np

from statorhom.diagnose.features.assignment import Keys
from statorhom.diagnose.features.lost_lines import lost_lines
from statorhom.diagnose.features.mixed_modes import cost_of
from statorhom.diagnose.features.third_lines import third_line
from statorhom.diagnose.measured.feature import LOST, SINGLE, Feature, Silence
from statorhom.diagnose.measured.measured_test import SHIFT_OWN, SHIFT_PART, MeasuredSplit, MeasuredTest
from statorhom.diagnose.predicted.prediction import PredictedMode
from statorhom.diagnose.predicted.sensor_response import SensorResponse
from statorhom.identify.residuals.model_error import DEFAULT_RELATIVE_SD, ModelError
from statorhom.model.convergence import ModeKey
from statorhom.study.modal_table import MeasuredMode

# of frequencies: floor, part of the mesh's correction, and what its square adds where the mesh is too coarse for that
OWN, OWN_PART, OWN_SQUARE = 5e-4, 0.05, 3.0
# of the correction, for every node plane along the axis beyond the first: four and six cells in the core show less
# surely how modes with two or three are corrected
PLANES_PART = 0.1
ALONE = 5e-3  # of a mode that only an arc of lost contact has: no finer mesh has shown it
# of either part of a stiffness wave 2r in the core: sheets, punching and welding vary that much, so that one of 2e-3 is
# nothing unusual
SCATTER_SD = 8e-4
SPLIT_OWN = 3e-4  # what the modes of one order differ by in it
SPLIT_PART = 0.05  # of a split: shape and foot of what causes it are not known
# of the splits of a test, root mean square: what of a local cause bends and what of it shears nearly cancels in some
# mode, and the rest says more of its shape than of its size
TYPICAL_PART = 0.1
UNRESOLVED = 0.6  # of the loss factor: standard deviation of a split that shows one mode alone


def free_features(
    test: MeasuredTest,
    modes: Sequence[MeasuredMode],
    keys: Keys,
    predicted: Mapping[ModeKey, PredictedMode],
    scatter: Mapping[int, complex],
    error: ModelError,
    discrepancy: float = 0.0,
) -> list[Feature]:
    """Frequencies and splits of a free test.

    Parameters
    ----------
    test, modes : the measurement, names corrected.
    keys : partner of every mode.
    predicted : modes by key.
    scatter : order → relative amplitude of what manufacturing scatter splits it by.
    error : mesh uncertainty.
    discrepancy : relative standard deviation that is added to all frequencies.
    """
    found: list[Feature] = []
    by_key = _by_partner(modes, keys)
    typical = _typical_split(test, [rows for key, rows in by_key.items() if key is not None])
    for key, rows in by_key.items():
        if key is None:
            lost = lost_lines(test, rows, modes, typical)
            found += [_called_alike(one, by_key, predicted, error, discrepancy) for one in lost]
        elif key in predicted:
            own = _Own(hypot(own_sd(error, key), discrepancy), hypot(OWN, discrepancy))
            ways = [
                _mode_features(test, rows, mode, scatter, own, TYPICAL_PART * typical)
                for mode in predicted[key].called
            ]
            found += min(ways, key=cost_of) if len(ways) > 1 else ways[0]
        else:
            found += _vanished(test, rows, key)
    return found


def _by_partner(modes: Sequence[MeasuredMode], keys: Keys) -> dict[ModeKey | None, list[MeasuredMode]]:
    """Measured modes by the key of their partner."""
    found: dict[ModeKey | None, list[MeasuredMode]] = {}
    for mode, key in zip(modes, keys, strict=True):
        found.setdefault(key, []).append(mode)
    return found


def _called_alike(
    lost: Feature,
    by_key: Mapping[ModeKey | None, Sequence[MeasuredMode]],
    predicted: Mapping[ModeKey, PredictedMode],
    error: ModelError,
    discrepancy: float,
) -> Feature:
    """A lost line, or the third one of the likeliest mode of its name."""
    row = next(m for m in by_key[None] if (m.label,) == lost.rows)
    thirds = [
        third_line(lost, row, mates, predicted[key], sd_and_least(row, own_sd(error, key), discrepancy))
        for key, mates in by_key.items()
        # most modes have no third line, and there are many
        if key is not None and key in predicted and predicted[key].lines
    ]
    return min([lost, *thirds], key=lambda f: cost_of([f]))


def _vanished(test: MeasuredTest, rows: Sequence[MeasuredMode], key: ModeKey) -> list[Feature]:
    """Penalties in the place of the features of a held partner that is predicted no more: as many, in their order."""
    labels = tuple(row.label for row in rows)
    if len(rows) == 1:
        kinds = ["frequency"] if key[0] == 0 or key[2] >= SINGLE else ["frequency", "split"]
    else:
        seen = _split_of(test, rows) is not None
        kinds = ["frequency", *(["split"] * (2 if seen else 0 if test.recorded else 1))]
    return [
        Feature(kind, test.name, key, 0.0, LOST if i < len(rows) else 0.0, 1.0, lost=True, rows=labels)
        for i, kind in enumerate(kinds)
    ]


def with_rows(found: Sequence[Feature], modes: Sequence[MeasuredMode], keys: Keys) -> list[Feature]:
    """Features of a free test with the labels of the measured modes that they are of."""
    # frequencies and splits have theirs: in wide valleys there is nothing else
    labels = {key: tuple(m.label for m in rows) for key, rows in _by_partner(modes, keys).items() if key}
    return [f if f.rows else replace(f, rows=labels.get(f.key, ()) if f.key else ()) for f in found]


def own_sd(error: ModelError, key: ModeKey) -> float:
    """Relative model error of a mode that others do not share: what of the mesh's is not in their common pattern."""
    correction = error.factor(key) - 1.0
    alone = ALONE if key[2] >= SINGLE else 0.0
    others = error.borrowed(key), error.sds.get(key, 0.0), alone
    part = OWN_PART + PLANES_PART * max(key[1] - 1, 0)
    return hypot(OWN, part * correction, OWN_SQUARE * correction**2, *others)


def doubt_by(frequency: Feature, error: ModelError) -> float:
    """`Feature.doubt` of a free mode's frequency if these were the mesh's factors."""
    if frequency.lost or frequency.key is None:
        return 0.0
    ratio = own_sd(error, frequency.key) / frequency.least
    return 0.5 * log(max(1.0, 1.0 + ratio**2 - (OWN / frequency.least) ** 2))


def measured_sd(mode: MeasuredMode) -> float:
    """Relative standard deviation of a measured frequency."""
    return DEFAULT_RELATIVE_SD if mode.frequency_sd_hz is None else mode.frequency_sd_hz / mode.frequency_hz


def sd_and_least(mode: MeasuredMode, own: float, discrepancy: float) -> tuple[float, float]:
    """Of a frequency that a model of error `own` predicts, and with the least error that any has (`Feature.least`)."""
    sd, least = (hypot(measured_sd(mode), model, discrepancy) for model in (own, OWN))
    return sd, least


class _Own(NamedTuple):
    """Relative model error of a mode that others do not share, and the least that any has."""

    sd: float
    least: float


def _frequency(
    test: MeasuredTest,
    rows: tuple[str, ...],
    predicted: PredictedMode,
    values: tuple[float, float],
    sd: float,
    own: _Own,
) -> Feature:
    """Of rows of a mode; `values` are measured and predicted ln f, `sd` that of the measurement."""
    return Feature(
        "frequency",
        test.name,
        predicted.key,
        *values,
        hypot(sd, own.sd),
        rows=rows,
        chance=predicted.chance,
        least=hypot(sd, own.least),
    )


def _mode_features(
    test: MeasuredTest,
    rows: Sequence[MeasuredMode],
    predicted: PredictedMode,
    scatter: Mapping[int, complex],
    own: _Own,
    shape: float,
) -> list[Feature]:
    """Of one mode; `own` and `shape` are what the mesh leaves open of its frequency, and a cause's shape of a split."""
    key = predicted.key
    scattered = predicted.scattered * scatter.get(key[0], 0j)
    split = predicted.split + scattered if predicted.multiplicity == 2 else 0j
    if len(rows) == 1:
        return _single(test, rows[0], predicted, split, own)
    low, high = rows[0], rows[-1]
    labels = tuple(row.label for row in rows)
    pairing = _split_of(test, rows)
    mean = (log(low.frequency_hz) + log(high.frequency_hz)) / 2
    sd = hypot(measured_sd(low), measured_sd(high)) / 2
    unresolved = test.recorded and pairing is None
    if unresolved:
        # images of one mode, or a doublet whose angles do not show: somewhere between
        sd = hypot(sd, log(high.frequency_hz / low.frequency_hz) / 2)
    found = [_frequency(test, labels, predicted, (mean, predicted.log_f), sd, own)]
    if unresolved:
        return found
    if pairing is not None:
        sd = _split_sd(pairing.sd, abs(pairing.relative), shape)
        parts = ((pairing.relative.real, split.real), (pairing.relative.imag, split.imag))
        return found + [Feature("split", test.name, key, m, p, sd, rows=labels) for m, p in parts]
    size, noise = _size_of(rows), 2 * hypot(measured_sd(low), measured_sd(high))
    sd = _split_sd(noise, size, shape)
    return [*found, Feature("split", test.name, key, size, abs(split), sd, rows=labels)]


def _split_sd(noise: float, size: float, shape: float) -> float:
    return hypot(noise, SPLIT_OWN, SPLIT_PART * size, shape)


def _size_of(rows: Sequence[MeasuredMode]) -> float:
    """Split of λ by two lines, relative."""
    return 2 * log(rows[-1].frequency_hz / rows[0].frequency_hz)


def _typical_split(test: MeasuredTest, doublets: Sequence[Sequence[MeasuredMode]]) -> float:
    """Root mean square of the splits that a test shows, none where it shows none."""
    if test.recorded:
        sizes = [abs(split.relative) for split in test.splits]
    else:
        sizes = [_size_of(rows) for rows in doublets if len(rows) > 1]
    return float(np.sqrt(np.mean(np.square(sizes)))) if sizes else 0.0


def _single(
    test: MeasuredTest, row: MeasuredMode, predicted: PredictedMode, split: complex, own: _Own
) -> list[Feature]:
    """One line of a doublet: not resolved, or its other line was missed."""
    log_f, measured = predicted.log_f, log(row.frequency_hz)
    sd, own_row = measured_sd(row), (row.label,)
    if predicted.multiplicity == 1:
        return [_frequency(test, own_row, predicted, (measured, log_f), sd, own)]
    # where the effect parts the two lines, it is one of them, a quarter of the split of λ to either side of the mean:
    # the nearer one, for in the middle there is none
    away = abs(predicted.split) / 4 if abs(predicted.split) > (row.loss_factor or 0.01) else 0.0
    log_f += copysign(away, measured - log_f)
    width = UNRESOLVED * (row.loss_factor or 0.01)
    # tables leave modes out, and know no angles
    most, parts = (3.0, 2) if test.recorded else (1.8, 1)
    silence = Silence(abs(split), width, most, parts)
    unresolved = float(silence.residual())
    return [
        _frequency(test, own_row, predicted, (measured, log_f), sd, own),
        Feature("split", test.name, predicted.key, 0.0, unresolved, 1.0, rows=own_row, silence=silence),
    ]


def _split_of(test: MeasuredTest, rows: Sequence[MeasuredMode]) -> MeasuredSplit | None:
    labels = {row.label for row in rows}
    return next((s for s in test.splits if {s.lower, s.upper} <= labels), None)


def shift_features(
    test: MeasuredTest, keys: Mapping[str, ModeKey], response: SensorResponse, sensor_kg: float
) -> list[Feature]:
    """Pole shifts from plane to plane by a sensor's mass.

    Parameters
    ----------
    keys : label of a measured mode → its name.
    response : of the named modes.
    """
    found = []
    for shifts in test.shifts:
        key = keys.get(shifts.label)
        if key is None or key not in response.slope:
            continue
        moved = response.shift(shifts.z_m, key, sensor_kg)
        moved = moved - moved.mean()
        # planes of one mode are no independent witnesses of its motion
        part = hypot(SHIFT_PART, response.doubt(shifts.z_m, key, shifts.shift)) * sqrt(len(moved))
        for measured, p, sd in zip(shifts.shift, moved, shifts.sd, strict=True):
            found.append(
                Feature("shift", test.name, key, float(measured), float(p), _shift_sd(sd, part * measured))
            )
    return found


def loading(test: MeasuredTest, key: ModeKey, response: SensorResponse, sensor_kg: float) -> float:
    """Mean fall of ln f by a sensor's mass over the test's measuring planes."""
    if key not in response.slope:
        return 0.0
    return -float(np.mean(response.shift(test.shifts[0].z_m, key, sensor_kg)))


def _shift_sd(sd: float, part: float) -> float:
    return hypot(sd, SHIFT_OWN, part)
