"""Long CSV tables of numbers, as measurements are: read at once by pandas, checked like all other tables."""

from __future__ import annotations

import io
import warnings
from collections.abc import Callable, Iterable
from pathlib import Path

import numpy as np
import pandas as pd

from statorhom.errors import RecordingError
from statorhom.recordings.message import recording_error
from statorhom.study.message import one_line, quoted
from statorhom.study.nearest import hint
from statorhom.study.text_file import read_text


class NumberTable:
    """Columns of a CSV file by their names.

    Parameters
    ----------
    path : Path
        A CSV file with a header; lines that begin with # are comments.

    Raises
    ------
    RecordingError, InputFileError
        Where it is no table.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        text = read_text(path)
        try:
            # pandas warns where rows are longer than the header, and then drops what is too long
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                self.frame = pd.read_csv(
                    io.StringIO(text), comment="#", skipinitialspace=True, index_col=False, low_memory=False
                )
        except (ValueError, OverflowError, Warning) as error:
            raise self.error(
                "", f"is no table ({one_line(str(error))})", "write a header and rows of cells"
            ) from None
        self.frame.columns = [str(column).strip() for column in self.frame.columns]
        if len(self.columns) == 1 and any(mark in self.columns[0] for mark in ";\t"):
            raise self.error("", "columns are not separated by commas", "save the table with commas")
        if not len(self.frame):
            raise self.error("", "has a header but no rows", "add what was measured")

    @property
    def columns(self) -> tuple[str, ...]:
        """Names in the order of the file."""
        return tuple(self.frame.columns)

    def require(
        self, required: Iterable[str], known: Iterable[str], is_known: Callable[[str], object]
    ) -> None:
        """Check the header.

        Raises
        ------
        RecordingError
        """
        known = tuple(known)
        for column in self.columns:
            if column not in known and not is_known(column):
                raise self.error("", f"unknown column {quoted(column)}", hint(column, known))
        for column in required:
            if column not in self.columns:
                raise self.error("", f"column {column} is missing", "add it (the first line is the header)")

    def numbers(self, column: str) -> np.ndarray:
        """A column as numbers; empty cells and nan are NaN.

        Raises
        ------
        RecordingError
        """
        cells = self.frame[column]
        if cells.dtype == bool or not pd.api.types.is_numeric_dtype(cells):
            values = pd.to_numeric(cells.astype("string").str.strip(), errors="coerce")
            wrong = np.flatnonzero(np.asarray(values.isna() & cells.notna()))
            if len(wrong):
                row = int(wrong[0])
                raise self.error(
                    f"row {row + 1}, column {column}",
                    f"{quoted(str(cells.iloc[row]))} is not a number",
                    "type a number with a decimal point",
                )
            cells = values.astype(float)
        return cells.to_numpy(dtype=float, na_value=np.nan)

    def error(self, where: str, problem: str, remedy: str) -> RecordingError:
        """The error to raise for a fault of this table."""
        return recording_error(self.path, where, problem, remedy)
