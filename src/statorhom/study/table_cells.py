"""Cells of a table: text that must be a number of some kind; an empty cell means "not known"."""

from __future__ import annotations

import math
from pathlib import Path

from statorhom.errors import InputFileError
from statorhom.study.message import input_error, quoted

_LARGEST_COUNT = 1000


def text(_path: Path, _line: int, _column: str, cell: str) -> str | None:
    """Any text."""
    return cell or None


def number(path: Path, line: int, column: str, cell: str) -> float | None:
    """A finite number."""
    if not cell:
        return None
    try:
        # float() also takes digit groups such as 1_432, which no table program writes
        value = math.nan if "_" in cell else float(cell)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise _error(
            path, line, column, f"{quoted(cell)} is not a number", "type a number with a decimal point"
        )
    return value


def positive(path: Path, line: int, column: str, cell: str) -> float | None:
    """A number above zero."""
    value = number(path, line, column, cell)
    if value is not None and value <= 0.0:
        raise _error(path, line, column, f"must be greater than 0, but is {value:g}", "correct the number")
    return value


def fraction(path: Path, line: int, column: str, cell: str) -> float | None:
    """A number between 0 and 1."""
    value = number(path, line, column, cell)
    if value is not None and not 0.0 < value < 1.0:
        raise _error(
            path,
            line,
            column,
            f"must lie between 0 and 1, but is {value:g}",
            "divide by 100 if it was typed in percent, or leave the cell empty",
        )
    return value


def count(path: Path, line: int, column: str, cell: str) -> int | None:
    """A whole number from 0."""
    value = number(path, line, column, cell)
    if value is None:
        return None
    if not value.is_integer() or not 0 <= value <= _LARGEST_COUNT:
        raise _error(
            path,
            line,
            column,
            f"must be a whole number from 0 to {_LARGEST_COUNT}, but is {value:g}",
            "correct it, or leave the cell empty where it is not known",
        )
    return int(value)


def _error(path: Path, line: int, column: str, problem: str, remedy: str) -> InputFileError:
    return input_error(path, f"line {line}, column {column}", problem, remedy)
