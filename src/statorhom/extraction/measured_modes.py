"""From the recordings of one test to its named modes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from statorhom.errors import IdentificationError, RecordingError
from statorhom.extraction.broad_modes import with_doubt
from statorhom.extraction.doublet_motion import whole_doublets
from statorhom.extraction.extract import extract
from statorhom.extraction.extraction import ExtractedMode, Extraction
from statorhom.extraction.flat_bodies import flat_body_names, flat_body_remarks, is_flat_body
from statorhom.extraction.mode_hints import ModeHints, mode_hints
from statorhom.extraction.second_sweep import second_stage
from statorhom.extraction.sensor_trend import SensorTrend, sensor_trend
from statorhom.extraction.turned_partner import turned_partners
from statorhom.modes.doublets import DoubletPair, find_doublets
from statorhom.modes.measured_name import MeasuredName, name_measured
from statorhom.modes.measured_shape import MeasuredShape, measured_shapes
from statorhom.modes.plan_form import PlanFormName
from statorhom.modes.point_layout import PointLayout, lay_out
from statorhom.modes.shape_features import ShapeFeatures, shape_features
from statorhom.recordings.estimation.estimate import estimate_frf
from statorhom.recordings.estimation.settings import SweepSettings
from statorhom.recordings.estimation.sweep import estimate_sweep_frf
from statorhom.recordings.frf_set import FrfSet
from statorhom.recordings.hit import Hit
from statorhom.recordings.placement import Placement
from statorhom.recordings.read import read_recording

CONFIDENT = 0.95  # probability from which on a name counts as known
LEAST_SHARE = 0.4  # of the radial motion that an order must have, to be the mode's
CLEAR = 0.6  # from which on it is nobody else's


@dataclass(frozen=True)
class NamedMode:
    """A measured mode and what its shape tells.

    Attributes
    ----------
    mode : ExtractedMode
    shape : MeasuredShape or None
        On the grid of the outermost points; None where the points lie around no axis.
    name : MeasuredName or None
        None together with the shape.
    features : ShapeFeatures or None
        Antinode and sidebands of a mode with an order.
    hints : ModeHints or None
        Whether its FRFs look non-linear.
    doublet : (r, n) or None
        Name of the mode whose other half this is, where a roving sensor turned both: the shape tells nothing.
    plan_form : PlanFormName or None
        Bending, torsion … of a plate or a wing; None for bodies around an axis.
    """

    mode: ExtractedMode
    shape: MeasuredShape | None = None
    name: MeasuredName | None = None
    features: ShapeFeatures | None = None
    hints: ModeHints | None = None
    doublet: tuple[int, int | None] | None = None
    plan_form: PlanFormName | None = None

    @property
    def order(self) -> int | None:
        """Circumferential order r; None where the points do not tell it beyond doubt."""
        if self.doublet is not None:
            return self.doublet[0]
        if self.name is None or self.name.name is None or self.order_share < LEAST_SHARE:
            return None
        return self.name.name.order if (self.name.confidence or 0.0) >= CONFIDENT else None

    @property
    def order_share(self) -> float:
        """Part of the radial motion that its strongest order has; 0 where nothing moves like that."""
        name = None if self.name is None else self.name.name
        return name.share if name is not None and name.kind == "radial" else 0.0

    @property
    def axial(self) -> int | None:
        """Axial node planes n; None where unknown."""
        if self.doublet is not None:
            return self.doublet[1]
        return None if self.order is None or not self.name or not self.name.name else self.name.name.axial


@dataclass(frozen=True)
class MeasuredModes:
    """The modes of one test, and what they were found from.

    Attributes
    ----------
    frf_sets : tuple of FrfSet
        As read, or as estimated from hits.
    extraction : Extraction
    modes : tuple of NamedMode
        In ascending frequency.
    doublets : tuple of DoubletPair
        By number in `modes`.
    remarks : tuple of str
        Of reading, estimation, extraction and naming.
    sensor : SensorTrend or None
        What the roving sensor's mass did to the poles; None where they do not move with it.
    """

    frf_sets: tuple[FrfSet, ...]
    extraction: Extraction
    modes: tuple[NamedMode, ...]
    doublets: tuple[DoubletPair, ...]
    remarks: tuple[str, ...]
    sensor: SensorTrend | None = None

    @property
    def bare_hz(self) -> tuple[float, ...]:
        """Frequencies of the modes, without the sensor's mass where it is known."""
        frequencies = [one.mode.frequency_hz for one in self.modes]
        if self.sensor is not None:
            for number, (frequency, _) in self.sensor.bare.items():
                frequencies[number] = frequency
        return tuple(frequencies)


def measured_modes(
    paths: Sequence[Path],
    placement: Placement | None = None,
    band_hz: tuple[float, float] | None = None,
    sweep: SweepSettings | None = None,
    *,
    hinted: bool = True,
) -> MeasuredModes:
    """Read recordings, estimate FRFs where they are time records, extract modes and name them.

    Parameters
    ----------
    paths : sequence of Path
        Files of one test.
    placement : Placement, optional
        Where points and directions are that the files do not say.
    band_hz : (low, high), optional
        Frequencies to look at; all by default.
    sweep : SweepSettings, optional
        Time records are sine sweeps, not hits.
    hinted : bool
        Whether peaks are looked at for hints that they are not linear, which takes a quarter of the time.

    Raises
    ------
    StatorhomError
        Where the files cannot be read or hold no modes; one line with file and remedy.
    """
    recording = read_recording(paths, placement)
    frf_sets, said = recording.frf_sets, list(recording.remarks)
    if not frf_sets:
        if not recording.hits:
            raise RecordingError(f"{paths[0]}: holds neither FRFs nor hits; export FRFs or time records")
        frf_sets, found = _estimated(recording.hits, sweep)
        said += found
    elif sweep is not None:
        raise RecordingError(f"{paths[0]}: holds FRFs, which need no sweep's band; leave it out")
    extraction = extract(frf_sets, band_hz)
    modes, remarks = _named(extraction)
    modes = _with_hints(modes, extraction, frf_sets[0]) if hinted else modes
    modes, sensor = _with_sensor(modes, extraction)
    doubted, broad = with_doubt([one.mode for one in modes])
    modes = tuple(replace(one, mode=mode) for one, mode in zip(modes, doubted, strict=True))
    said += [*extraction.remarks, *remarks, *_moving(modes, sensor), *_non_linear(modes), *broad]
    if sweep is not None:
        said += second_stage(extraction.modes)
    return MeasuredModes(frf_sets, extraction, modes, _doublets(modes), tuple(dict.fromkeys(said)), sensor)


def _estimated(records: Sequence[Hit], sweep: SweepSettings | None) -> tuple[tuple[FrfSet, ...], list[str]]:
    """FRFs from time records, and what is to be said of these."""
    if sweep is not None:
        return (estimate_sweep_frf(records, sweep),), []
    estimate = estimate_frf(records)
    return estimate.frf_sets, [fault.statement for fault in estimate.faults]


def _with_sensor(
    modes: Sequence[NamedMode], extraction: Extraction
) -> tuple[tuple[NamedMode, ...], SensorTrend | None]:
    """Names of turned doublets' other halves, and the sensor's mass where it is beyond doubt."""
    if extraction.hammer_roved:
        return tuple(modes), None
    names = {i: (one.order, one.axial) for i, one in enumerate(modes) if one.order is not None}
    clear = [i for i, one in enumerate(modes) if i in names and one.order_share > CLEAR]
    loaded = extraction.loaded
    partners = {} if loaded is not None else turned_partners(extraction.modes, names, clear)
    named = tuple(
        replace(one, doublet=partners[i], features=None) if i in partners else one
        for i, one in enumerate(modes)
    )
    whole = {i: (order, axial) for i, (order, axial) in names.items() if axial is not None}
    moving, halves = (extraction.modes, {}) if loaded is None else whole_doublets(extraction.modes, loaded)
    trend = sensor_trend(moving, whole, extraction.points, extraction.references[0])
    trend = None if trend is None else replace(trend, partners=halves)
    return named, trend if trend is not None and trend.significant else None


def _moving(modes: Sequence[NamedMode], sensor: SensorTrend | None) -> list[str]:
    """Poles that move, and why."""
    if sensor is not None:
        return [sensor.statement]
    spans = [(float(np.ptp(one.mode.shift.real)), one.mode) for one in modes if one.mode.shift is not None]
    if not spans:
        return []
    span, mode = max(spans, key=lambda pair: pair[0])
    what = "point" if mode.shift is not None and len(mode.shift) > 1 else "reference"
    return [
        f"the poles of {len(spans)} modes move from {what} to {what}, by up to {100 * span:.2g} % at "
        f"{mode.frequency_hz:.2f} Hz: the structure, its supports or what was attached to it changed during the test"
    ]


def _named(extraction: Extraction) -> tuple[tuple[NamedMode, ...], list[str]]:
    if is_flat_body(extraction.points):
        names = flat_body_names(extraction.modes, extraction.points)
        pairs = zip(extraction.modes, names, strict=True)
        return tuple(NamedMode(mode, plan_form=name) for mode, name in pairs), flat_body_remarks(names)
    try:
        layout = lay_out(extraction.points)
    except IdentificationError as error:
        return tuple(NamedMode(mode) for mode in extraction.modes), [f"modes have no names: {error}"]
    named = tuple(_name(mode, layout) for mode in extraction.modes)
    return named, [remark for one in named if one.shape is not None for remark in one.shape.remarks]


def _name(mode: ExtractedMode, layout: PointLayout) -> NamedMode:
    shape = measured_shapes(layout, mode.shape, mode.shape_sd)[0]
    name = name_measured(shape)
    has_order = name.name is not None and name.name.order is not None
    return NamedMode(mode, shape, name, shape_features(shape) if has_order else None)


def _with_hints(modes: Sequence[NamedMode], extraction: Extraction, frfs: FrfSet) -> tuple[NamedMode, ...]:
    """Hints of the modes whose poles stay: one pole does not describe the FRFs of the others."""
    every = [*extraction.modes, *extraction.outside]
    return tuple(
        one
        if one.mode.shift is not None
        else replace(
            one, hints=mode_hints(frfs, _pole(one.mode), [_pole(e) for e in every if e is not one.mode])
        )
        for one in modes
    )


def _pole(mode: ExtractedMode) -> tuple[float, float]:
    return mode.frequency_hz, mode.observed.imag / mode.observed.real


def _non_linear(modes: Sequence[NamedMode]) -> list[str]:
    return [
        f"the peak at {one.mode.frequency_hz:.2f} Hz is not that of one linear mode: {one.hints.statement}; "
        "the mode is not linear, or another one hides in it"
        for one in modes
        if one.hints is not None and one.hints.remarkable
    ]


def _doublets(modes: Sequence[NamedMode]) -> tuple[DoubletPair, ...]:
    antinodes = [
        None if one.order is None or one.features is None else one.features.antinode for one in modes
    ]
    return find_doublets(
        [one.axial for one in modes],
        antinodes,
        [one.mode.frequency_hz for one in modes],
        [one.mode.frequency_sd_hz for one in modes],
        [one.mode.shape for one in modes],
    )
