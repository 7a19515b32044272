"""Modes of a test's recordings, as a modal table, shapes and plots."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from statorhom.errors import InputFileError, RecordingError
from statorhom.extraction.measured_modes import MeasuredModes, measured_modes
from statorhom.identify.processes.announce import Announce, silent
from statorhom.modes.plan_form import ordinal_labels
from statorhom.recordings.estimation.settings import SweepSettings
from statorhom.recordings.placement import Placement
from statorhom.report.recordings.modes_folder import picture_count, write_modes
from statorhom.study.study_file import read_study_file

if TYPE_CHECKING:
    import pandas as pd

LINES = 1000  # of a sweep's band, where the length of the segments is not given


def measure(
    recordings: Sequence[Path],
    study: Path | None = None,
    out: Path | None = None,
    announce: Announce = silent,
    sweep: SweepSettings | None = None,
) -> tuple[pd.DataFrame, tuple[Path, ...]]:
    """Extract the modes of a test and write modes.csv, shapes.uff and plots/ into a folder.

    Parameters
    ----------
    recordings : sequence of Path
        Files of one test.
    study : Path, optional
        Study file; its test with these files says where hammer and sensor were.
    out : Path, optional
        The folder; by default `<name of the first file>-results` beside it.
    announce : callable
        Told what begins.
    sweep : SweepSettings, optional
        Time records are sine sweeps, not hits.

    Returns
    -------
    table, paths : the modes, and what was written.

    Raises
    ------
    StatorhomError
        Where files cannot be read, hold no modes or results cannot be written.
    """
    placement = None if study is None else _placement(study, recordings)
    done = announce("modal extraction", 1)
    measured = measured_modes(recordings, placement, sweep=sweep)
    done(1)
    folder = recordings[0].parent / f"{recordings[0].stem}-results" if out is None else out
    paths = write_modes(measured, folder, announce("plots", picture_count(measured)))
    return _table(measured), paths


def sweep_settings(band_hz: tuple[float, float] | None, segment_s: float | None) -> SweepSettings | None:
    """Settings from what the user typed; None where nothing was.

    Raises
    ------
    RecordingError
        When the segment is given without the band, or a value is none of a sweep.
    """
    if band_hz is None:
        if segment_s is not None:
            raise RecordingError("--segment-s belongs to sweeps: give --sweep-hz START STOP as well")
        return None
    start, stop = band_hz
    return SweepSettings(start, stop, LINES / max(stop - start, 1e-9) if segment_s is None else segment_s)


def _placement(study: Path, recordings: Sequence[Path]) -> Placement:
    """Keys of the study's test that has these files."""
    wanted = {path.resolve() for path in recordings}
    for stage in read_study_file(study).stages:
        for test in stage.tests:
            if wanted <= {(study.parent / path).resolve() for path in test.paths}:
                return Placement.of_test(test)
    names = ", ".join(str(path) for path in recordings)
    raise InputFileError(f"{study}: no test has {names}; add the test or leave --study out")


def _table(measured: MeasuredModes) -> pd.DataFrame:
    import pandas as pd

    rows = [
        {
            "mode": number,
            "frequency_hz": one.mode.frequency_hz,
            "frequency_sd_hz": one.mode.frequency_sd_hz,
            "loss_factor": one.mode.loss_factor,
            "loss_factor_sd": one.mode.loss_factor_sd,
            "order": one.order,
            "axial": one.axial,
            "share": None if one.name is None or one.name.name is None else one.name.name.share,
            "phase_collinearity": one.mode.phase_collinearity,
        }
        for number, one in enumerate(measured.modes, start=1)
    ]
    table = pd.DataFrame(rows)
    if any(one.plan_form is not None for one in measured.modes):
        table["name"] = ordinal_labels([one.plan_form for one in measured.modes])
        table["shape"] = ["" if one.plan_form is None else one.plan_form.statement for one in measured.modes]
    if measured.sensor is not None:
        numbers = table["mode"] - 1
        for column, position in (("frequency_without_sensor_hz", 0), ("frequency_without_sensor_sd_hz", 1)):
            found = {number: pair[position] for number, pair in measured.sensor.bare.items()}
            table[column] = numbers.map(found)
    return table.astype({"order": "Int64", "axial": "Int64"}) if rows else table
