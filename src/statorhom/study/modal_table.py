"""Modal tables: measured frequencies, damping, labels and modal constants in a CSV file."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from statorhom.study import table_cells
from statorhom.study.csv_file import Row, read_csv
from statorhom.study.message import input_error

# Stators that are light enough to be tested by hand have no elastic mode below this.
_LOWEST_PLAUSIBLE_HZ = 50.0

_COLUMNS = {
    "frequency_hz": table_cells.positive,
    "frequency_sd_hz": table_cells.positive,
    "damping_ratio": table_cells.fraction,
    "loss_factor": table_cells.fraction,
    "order": table_cells.count,
    "axial": table_cells.count,
    "modal_constant_per_kg": table_cells.number,
    "modal_constant_phase_deg": table_cells.number,
    "mode": table_cells.text,
    "loss_factor_sd": table_cells.positive,
    "damping_ratio_sd": table_cells.positive,
    "frequency_without_sensor_hz": table_cells.positive,
    "frequency_without_sensor_sd_hz": table_cells.positive,
}


@dataclass(frozen=True)
class MeasuredMode:
    """One row of a modal table.

    Attributes
    ----------
    row : int
        Number of the row, from 1, comments and header not counted.
    mode : str or None
        The user's own name or number of the mode.
    frequency_hz, frequency_sd_hz : float, Hz
        Natural frequency and its standard deviation.
    loss_factor : float
        Structural loss factor, twice the damping ratio.
    order, axial : int or None
        Circumferential order r and number n of axial node planes, where the user knows them.
    modal_constant_per_kg, modal_constant_phase_deg : float, 1/kg and degrees
        Modal constant of the receptance.
    loss_factor_sd : float or None
        Standard deviation of the loss factor.
    frequency_without_sensor_hz, frequency_without_sensor_sd_hz : float or None, Hz
        What the frequency would be without the mass of a roving accelerometer, where its poles tell that.
    """

    row: int
    mode: str | None
    frequency_hz: float
    frequency_sd_hz: float | None = None
    loss_factor: float | None = None
    order: int | None = None
    axial: int | None = None
    modal_constant_per_kg: float | None = None
    modal_constant_phase_deg: float | None = None
    loss_factor_sd: float | None = None
    frequency_without_sensor_hz: float | None = None
    frequency_without_sensor_sd_hz: float | None = None

    @property
    def label(self) -> str:
        """What ``hold_out`` calls this mode: its own number, else the number of its row."""
        return self.mode if self.mode is not None else str(self.row)


@dataclass(frozen=True)
class ModalTable:
    """The modes of one test.

    Attributes
    ----------
    path : Path
        Where they were read from.
    modes : tuple of MeasuredMode
        In the order of the file; at least one.
    remarks : tuple of str
        What a reader must know of the recordings that the table comes from.
    """

    path: Path
    modes: tuple[MeasuredMode, ...]
    remarks: tuple[str, ...] = ()


def read_modal_table(path: Path) -> ModalTable:
    """Read a modal table.

    Parameters
    ----------
    path : Path
        A CSV file with a header; lines that begin with # are comments. ``frequency_hz`` is required, cells of
        all other columns may be empty.

    Returns
    -------
    ModalTable

    Raises
    ------
    InputFileError
        One line with file, row, column and remedy.
    """
    header, rows = read_csv(path, known=tuple(_COLUMNS), required=("frequency_hz",))
    for end in ("", "_sd"):
        if {f"damping_ratio{end}", f"loss_factor{end}"} <= set(header):
            what = f"has both damping_ratio{end} and loss_factor{end}"
            raise input_error(path, "header", what, "keep one of the two (loss = 2 damping)")
    table = ModalTable(path, tuple(_mode(path, number, row) for number, row in enumerate(rows, start=1)))
    _refuse_kilohertz(table)
    _refuse_duplicates(table)
    return table


def _mode(path: Path, number: int, row: Row) -> MeasuredMode:
    values: dict[str, Any] = {
        column: _COLUMNS[column](path, row.line, column, cell) for column, cell in row.cells.items()
    }
    if values["frequency_hz"] is None:
        raise input_error(
            path, f"line {row.line}, column frequency_hz", "is empty", "type the frequency or delete the row"
        )
    for column in ("damping_ratio", "damping_ratio_sd"):
        damping = values.pop(column, None)
        if damping is not None:
            values[column.replace("damping_ratio", "loss_factor")] = 2.0 * damping
    return MeasuredMode(row=number, **{"mode": None, **values})


def _refuse_kilohertz(table: ModalTable) -> None:
    highest = max(mode.frequency_hz for mode in table.modes)
    if highest < _LOWEST_PLAUSIBLE_HZ:
        raise input_error(
            table.path,
            "column frequency_hz",
            f"all frequencies lie below {_LOWEST_PLAUSIBLE_HZ:g} Hz (highest {highest:g}), as if in kHz",
            "multiply the column by 1000",
        )


def _refuse_duplicates(table: ModalTable) -> None:
    seen: dict[tuple[float, int | None, int | None], int] = {}
    for mode in table.modes:
        key = (mode.frequency_hz, mode.order, mode.axial)
        if key in seen:
            raise input_error(
                table.path,
                f"rows {seen[key]} and {mode.row}",
                f"duplicate mode ({mode.frequency_hz:g} Hz twice with the same order and axial)",
                "delete one of the rows; a doublet is listed twice only with its two frequencies",
            )
        seen[key] = mode.row
