"""Extracted modes as a modal table of the file contract."""

from __future__ import annotations

import cmath
import csv
import io
import math
from collections.abc import Sequence
from pathlib import Path

from statorhom.extraction.measured_modes import MeasuredModes, NamedMode
from statorhom.study.modal_table import MeasuredMode, ModalTable

COLUMNS = (
    "mode",
    "frequency_hz",
    "frequency_sd_hz",
    "loss_factor",
    "loss_factor_sd",
    "order",
    "axial",
    "modal_constant_per_kg",
    "modal_constant_phase_deg",
)
# only in the table of a test whose poles a sensor moved
SENSOR_COLUMNS = ("frequency_without_sensor_hz", "frequency_without_sensor_sd_hz")


def modal_table(measured: MeasuredModes, path: Path) -> ModalTable:
    """The modes as a study's test has them; `path` is where they came from, for messages."""
    bare = {} if measured.sensor is None else measured.sensor.bare
    rows = [_row(number, one, bare.get(number - 1)) for number, one in enumerate(measured.modes, start=1)]
    return ModalTable(path, tuple(rows))


def table_text(table: ModalTable, remarks: Sequence[str] = ()) -> str:
    """CSV with a header, remarks as comments before it."""
    file = io.StringIO()
    for remark in remarks:
        file.write(f"# {' '.join(remark.split())}\n")
    writer = csv.writer(file, lineterminator="\n")
    moved = any(mode.frequency_without_sensor_hz is not None for mode in table.modes)
    columns = COLUMNS + SENSOR_COLUMNS * moved
    writer.writerow(columns)
    for mode in table.modes:
        writer.writerow(["" if getattr(mode, c) is None else _text(getattr(mode, c)) for c in columns])
    return file.getvalue()


def _row(number: int, one: NamedMode, bare: tuple[float, float] | None) -> MeasuredMode:
    mode = one.mode
    constant = mode.modal_constant_per_kg
    return MeasuredMode(
        row=number,
        mode=str(number),
        frequency_hz=mode.frequency_hz,
        frequency_sd_hz=mode.frequency_sd_hz,
        # a window's correction may leave less than nothing of a damping that was hardly there
        loss_factor=mode.loss_factor if 0.0 < mode.loss_factor < 1.0 else None,
        loss_factor_sd=mode.loss_factor_sd if 0.0 < mode.loss_factor < 1.0 else None,
        order=one.order,
        axial=one.axial,
        modal_constant_per_kg=None if constant is None else abs(constant),
        modal_constant_phase_deg=None if constant is None else math.degrees(cmath.phase(constant)),
        frequency_without_sensor_hz=None if bare is None else bare[0],
        frequency_without_sensor_sd_hz=None if bare is None else bare[1],
    )


def _text(value: object) -> str:
    return f"{value:.9g}" if isinstance(value, float) else str(value)
