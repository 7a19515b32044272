"""Modes of a test's recordings, as a modal table, shapes and plots."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from statorhom.errors import InputFileError
from statorhom.extraction.measured_modes import MeasuredModes, measured_modes
from statorhom.identify.announce import Announce, silent
from statorhom.recordings.placement import Placement
from statorhom.report.recordings.modes_folder import picture_count, write_modes
from statorhom.study.study_file import read_study_file

if TYPE_CHECKING:
    import pandas as pd


def measure(
    recordings: Sequence[Path],
    study: Path | None = None,
    out: Path | None = None,
    announce: Announce = silent,
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
    measured = measured_modes(recordings, placement)
    done(1)
    folder = recordings[0].parent / f"{recordings[0].stem}-results" if out is None else out
    paths = write_modes(measured, folder, announce("plots", picture_count(measured)))
    return _table(measured), paths


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
    if measured.sensor is not None:
        numbers = table["mode"] - 1
        for column, position in (("frequency_without_sensor_hz", 0), ("frequency_without_sensor_sd_hz", 1)):
            found = {number: pair[position] for number, pair in measured.sensor.bare.items()}
            table[column] = numbers.map(found)
    return table.astype({"order": "Int64", "axial": "Int64"}) if rows else table
