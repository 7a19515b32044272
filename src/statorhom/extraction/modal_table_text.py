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
    "order",
    "axial",
    "modal_constant_per_kg",
    "modal_constant_phase_deg",
)


def modal_table(measured: MeasuredModes, path: Path) -> ModalTable:
    """The modes as a study's test has them; `path` is where they came from, for messages."""
    rows = [_row(number, one) for number, one in enumerate(measured.modes, start=1)]
    return ModalTable(path, tuple(rows))


def table_text(table: ModalTable, remarks: Sequence[str] = ()) -> str:
    """CSV with a header, remarks as comments before it."""
    file = io.StringIO()
    for remark in remarks:
        file.write(f"# {' '.join(remark.split())}\n")
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(COLUMNS)
    for mode in table.modes:
        writer.writerow(["" if getattr(mode, c) is None else _text(getattr(mode, c)) for c in COLUMNS])
    return file.getvalue()


def _row(number: int, one: NamedMode) -> MeasuredMode:
    mode = one.mode
    constant = mode.modal_constant_per_kg
    return MeasuredMode(
        row=number,
        mode=str(number),
        frequency_hz=mode.frequency_hz,
        frequency_sd_hz=mode.frequency_sd_hz,
        # a window's correction may leave less than nothing of a damping that was hardly there
        loss_factor=mode.loss_factor if 0.0 < mode.loss_factor < 1.0 else None,
        order=one.order,
        axial=one.axial,
        modal_constant_per_kg=None if constant is None else abs(constant),
        modal_constant_phase_deg=None if constant is None else math.degrees(cmath.phase(constant)),
    )


def _text(value: object) -> str:
    return f"{value:.9g}" if isinstance(value, float) else str(value)
