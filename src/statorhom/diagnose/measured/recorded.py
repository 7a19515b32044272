"""What the tests of a study measured: tables as typed, recordings as extracted, and kept beside the results."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable
from dataclasses import asdict, dataclass, replace
from pathlib import Path

import numpy as np
from threadpoolctl import threadpool_limits

from statorhom.diagnose.measured.body_points import body_points, distinct_modes
from statorhom.diagnose.measured.measured_test import (
    MeasuredPoints,
    MeasuredShapes,
    MeasuredSplit,
    MeasuredTest,
    PlaneShifts,
    Sideband,
)
from statorhom.diagnose.measured.plane_shifts import (
    distinct_doublets,
    doubtful_axial,
    plane_shifts,
    strongest,
)
from statorhom.extraction.extraction import ExtractedMode
from statorhom.extraction.flat_bodies import is_flat_body
from statorhom.extraction.measured_modes import MeasuredModes, measured_modes
from statorhom.extraction.modal_table_text import modal_table
from statorhom.identify.processes.announce import Announce, silent
from statorhom.identify.processes.workers import Tick, Workers
from statorhom.modes.doublets import DoubletPair
from statorhom.recordings.placement import Placement
from statorhom.study.atomic import write_text
from statorhom.study.frozen_map import FrozenMap
from statorhom.study.message import input_error
from statorhom.study.modal_table import MeasuredMode, ModalTable
from statorhom.study.modal_tests import ModalTestKeys
from statorhom.study.study import StudyFiles

FOLDER, FORMAT = "recordings", 19  # a change of method makes what is kept stale
# A resonance of a loss factor of 8 % has others under its flanks: recordings of a known stator then miss frequencies
# by 0.1 to 0.7 %, whatever the noise; at 5 % they hardly do.
OVERLAP = 8.0
KNOWN = 0.5  # of its bandwidth, that a mode's frequency has to be known to


@dataclass(frozen=True)
class RecordedTest:
    """What one test's extraction needs; can be sent to another process.

    Parameters
    ----------
    study : path of the study file.
    keys : of the test.
    stage : number of its stage.
    folder : where its modes are kept.
    """

    study: Path
    keys: ModalTestKeys
    stage: int
    folder: Path


def measured_tests(
    files: StudyFiles, folder: Path, announce: Announce = silent, jobs: int = 1
) -> tuple[StudyFiles, dict[str, MeasuredTest]]:
    """The study with tables of all tests, and its tests by name.

    Parameters
    ----------
    jobs : processes that extract modes.

    Raises
    ------
    StatorhomError
        Where recordings cannot be read or hold no modes.
    """
    stages = list(enumerate(files.study.stages))
    recorded = [
        RecordedTest(files.path, test, number, folder / FOLDER)
        for number, stage in stages
        for test in stage.tests
        if test.name not in files.tables
    ]
    progress = announce("modal extraction", max(1, len(recorded)))
    with Workers(jobs) as workers:
        extracted = workers.map(_recorded, recorded, progress=progress) if recorded else []
    known = {one.name: one for one in extracted}
    tables, found = dict(files.tables), {}
    for number, stage in stages:
        for test in stage.tests:
            if test.name in files.tables:
                modes = tuple(sorted(files.tables[test.name].modes, key=lambda m: m.frequency_hz))
                found[test.name] = MeasuredTest(number, test.name, test.support, modes)
            else:
                found[test.name] = known[test.name]
                tables[test.name] = ModalTable(files.path, known[test.name].modes)
    return replace(files, tables=FrozenMap(tables)), found


def _recorded(task: RecordedTest, tick: Tick) -> MeasuredTest:
    test, stage = task.keys, task.stage
    paths = [task.study.parent / name for name in test.paths]
    digest = hashlib.sha256(f"{FORMAT} {Placement.of_test(test)}".encode())
    for path in paths:
        digest.update(path.read_bytes())
    kept = task.folder / f"{test.name}-diagnosis.json"
    known = _read(kept, digest.hexdigest())
    if known is not None:
        tick()
        return replace(known, stage=stage, name=test.name, support=test.support)
    with threadpool_limits(limits=1, user_api="blas"):
        measured = measured_modes(paths, Placement.of_test(test), hinted=False)
        if not measured.modes:
            raise input_error(
                task.study, f"tests[{test.name}]", "no mode stands out of the noise", "repeat the test"
            )
        found = from_recording(measured, stage, test.name, test.support, paths[0])
    write_text(kept, json.dumps({"digest": digest.hexdigest(), "test": asdict(found)}, default=_plain) + "\n")
    tick()
    return found


def from_recording(measured: MeasuredModes, stage: int, name: str, support: str, path: Path) -> MeasuredTest:
    """A test from its extracted modes; weaker images of one mode are left out."""
    doublets = distinct_doublets(measured)
    paired = {i for d in doublets for i in (d.lower, d.upper)}
    flat = is_flat_body(measured.extraction.points)
    distinct = set(distinct_modes(measured) if flat else strongest(measured.modes, paired))
    kept = paired & distinct | _somewhere(measured, distinct)
    shifts = plane_shifts(measured)
    moved = {s.label: 1.0 + s.mean for s in shifts}
    for d in doublets:
        # both modes of a doublet move alike: each point sees the one whose antinode it is
        own = [moved[label] for i in (d.lower, d.upper) if (label := str(i + 1)) in moved]
        moved |= {str(i + 1): own[0] for i in (d.lower, d.upper) if own}
    uneven = {i: _uneven(measured, d) for d in doublets for i in (d.lower, d.upper)}
    doubtful = set() if flat else doubtful_axial(measured.modes, sorted(kept))
    rows = [
        replace(
            row,
            frequency_hz=row.frequency_hz * moved.get(row.label, 1.0),
            axial=None if i in doubtful else row.axial,
            frequency_sd_hz=_frequency_sd(row, uneven.get(i, 0.0)),
        )
        for i, row in enumerate(modal_table(measured, path).modes)
    ]
    return MeasuredTest(
        stage,
        name,
        support,
        tuple(row for i, row in enumerate(rows) if i in kept),
        recorded=True,
        splits=tuple(_split(measured, d) for d in doublets),
        shifts=shifts,
        sidebands=tuple(s for i in sorted(kept) if (s := _sideband(measured, i)) is not None),
        shapes=_shapes(measured, sorted(kept)),
        points=body_points(measured, sorted(kept)),
    )


def _somewhere(measured: MeasuredModes, numbers: Iterable[int]) -> set[int]:
    """Those whose frequency is known: a peak that may be anywhere under its own width has no row, nor a partner."""
    modes = {i: measured.modes[i].mode for i in numbers}
    return {i for i, mode in modes.items() if mode.frequency_sd_hz < KNOWN * mode.bandwidth_hz} or set(modes)


def _split(measured: MeasuredModes, d: DoubletPair) -> MeasuredSplit:
    modes = [measured.modes[i].mode for i in (d.lower, d.upper)]
    mean = float(np.mean([(2 * np.pi * mode.frequency_hz) ** 2 for mode in modes]))
    sd = float(np.sqrt(np.trace(d.split_covariance) / 2)) / mean
    # of two modes that a sensor moves a point sees one: what their poles differ by is known no better than they move
    # unless both are known as they are without it
    loaded = measured.extraction.loaded
    alike = loaded is not None and loaded.mode_of[d.lower] == loaded.mode_of[d.upper]
    moved = 0.0 if alike else min(_moved(mode) for mode in modes)
    broad = overlap_sd(max(mode.loss_factor for mode in modes))
    known = float(np.linalg.norm([sd, 2.0 * moved, 2.0 * broad, _uneven(measured, d)]))
    return MeasuredSplit(str(d.lower + 1), str(d.upper + 1), d.split / mean, known)


def _uneven(measured: MeasuredModes, d: DoubletPair) -> float:
    """What the loss factors of a doublet's modes differ by: they dissipate alike, so that poles are off by as much.

    A neighbour under the same peak pulls a pole along both of its axes, and no noise tells how far.
    """
    low, high = (measured.modes[i].mode.loss_factor for i in (d.lower, d.upper))
    return abs(high - low)


def _frequency_sd(row: MeasuredMode, uneven: float) -> float:
    """Standard deviation of a frequency (Hz), with what neighbours leave open."""
    relative = float(np.hypot(overlap_sd(row.loss_factor), 0.5 * uneven))
    return float(np.hypot(row.frequency_sd_hz or 0.0, relative * row.frequency_hz))


def overlap_sd(loss_factor: float | None) -> float:
    """Relative standard deviation of a frequency by the modes that nobody finds between resonances as broad as this."""
    return OVERLAP * (loss_factor or 0.0) ** 3


def _moved(mode: ExtractedMode) -> float:
    """Standard deviation of a mode's relative shifts from set-up to set-up; 0 for one that stays."""
    return 0.0 if mode.shift is None else float(np.std(np.real(mode.shift)))


def _sideband(measured: MeasuredModes, number: int) -> Sideband | None:
    one = measured.modes[number]
    if one.order is None or one.features is None or one.features.antinode is None or one.shape is None:
        return None
    f = one.features
    angle = f.antinode.angle_rad if f.antinode else 0.0
    sd = np.nanmean(f.sideband_sd, axis=2)
    return Sideband(str(number + 1), f.order, angle, f.sideband_cosine, f.sideband_sine, sd, one.shape.z_m)


def _shapes(measured: MeasuredModes, kept: list[int]) -> MeasuredShapes | None:
    shapes = [measured.modes[i].shape for i in kept]
    first = next((s for s in shapes if s is not None), None)
    if first is None or any(s is None for s in shapes):
        return None
    motion = []
    for s in shapes:
        assert s is not None
        phase = 0.5 * np.angle(np.nansum(s.radial**2))
        motion.append((s.radial * np.exp(-1j * phase)).real)
    return MeasuredShapes(tuple(str(i + 1) for i in kept), first.z_m, first.angles_rad, np.array(motion))


def _plain(value: object) -> object:
    if isinstance(value, complex):
        return [value.real, value.imag]
    if isinstance(value, np.ndarray | np.generic):
        return value.tolist()
    raise TypeError(type(value).__name__)


def _read(path: Path, digest: str) -> MeasuredTest | None:
    """What is kept, None where it is missing, stale or damaged."""
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
        if content["digest"] != digest:
            return None
        t = content["test"]
        return MeasuredTest(
            t["stage"],
            t["name"],
            t["support"],
            tuple(MeasuredMode(**m) for m in t["modes"]),
            t["recorded"],
            tuple(
                MeasuredSplit(s["lower"], s["upper"], complex(*s["relative"]), s["sd"]) for s in t["splits"]
            ),
            tuple(
                PlaneShifts(
                    s["label"], np.array(s["z_m"]), np.array(s["shift"]), np.array(s["sd"]), s["mean"]
                )
                for s in t["shifts"]
            ),
            tuple(
                Sideband(
                    s["label"],
                    s["order"],
                    s["angle_rad"],
                    *(np.array(s[k], dtype=float) for k in ("cosine", "sine", "sd", "z_m")),
                )
                for s in t["sidebands"]
            ),
            _read_shapes(t["shapes"]),
            _read_points(t["points"]),
        )
    except (OSError, ValueError, KeyError, TypeError):
        return None


def _read_points(table: dict[str, list | None] | None) -> MeasuredPoints | None:
    if table is None:
        return None
    return MeasuredPoints(
        **{k: None if v is None else np.array(v, dtype=float) for k, v in table.items()}  # type: ignore[arg-type]
    )


def _read_shapes(table: dict[str, list] | None) -> MeasuredShapes | None:
    if table is None:
        return None
    arrays = (np.array(table[k], dtype=float) for k in ("z_m", "angles_rad", "radial"))
    return MeasuredShapes(tuple(table["labels"]), *arrays)
