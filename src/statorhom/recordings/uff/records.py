"""Records of a universal file: lines with fields in fixed columns, as Fortran writes them."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from pathlib import Path

from statorhom.errors import RecordingError
from statorhom.recordings.message import recording_error
from statorhom.study.message import quoted

# Fortran leaves out the letter where the exponent has three digits
_NO_LETTER = re.compile(r"(?<=[\d.])([+-]\d+)$")
_LARGEST_INTEGER = 10**12

Field = tuple[int, type]


@dataclass(frozen=True)
class Place:
    """A dataset of a file, for messages: the file, the dataset's place in it from 1, and its type."""

    path: Path
    dataset: int
    kind: int

    def error(self, line: int | None, problem: str, remedy: str = "export the file again") -> RecordingError:
        """The error to raise for a fault in this dataset, at one of its lines (from 1) or as a whole."""
        where = f"dataset {self.dataset} (type {self.kind})"
        return recording_error(self.path, where if line is None else f"{where}, line {line}", problem, remedy)


def fields(place: Place, line: int, text: str, widths: tuple[Field, ...]) -> list:
    """Values of a record.

    Columns are fixed, but some programs only separate by blanks: where the columns do not hold what they
    should, the words of the line are taken.

    Parameters
    ----------
    place : Place
    line : int
        Line of the dataset, for messages.
    text : str
        The record.
    widths : tuple of (int, type)
        Width of each field and its type: int, float or str. Blank numbers are 0.

    Returns
    -------
    list
        One value per field.

    Raises
    ------
    RecordingError
        Where neither columns nor words fit.
    """
    columns, start = [], 0
    for width, _ in widths:
        columns.append(text[start : start + width].strip())
        start += width
    words = text.split()
    candidates = [columns, words] if len(words) == len(widths) else [columns]
    for cells in candidates:
        try:
            return [_value(cell, kind) for cell, (_, kind) in zip(cells, widths, strict=True)]
        except ValueError:
            continue
    raise place.error(line, f"{quoted(text.rstrip())} does not hold the numbers that belong there")


def reals(place: Place, line: int, text: str, count: int) -> list[float]:
    """Finite numbers of a record that blanks separate.

    Raises
    ------
    RecordingError
        Where there are fewer, or one is not a finite number.
    """
    try:
        values = [number(word) for word in text.split()[:count]]
    except ValueError:
        values = []
    if len(values) != count or not all(map(math.isfinite, values)):
        raise place.error(line, f"{quoted(text.strip())} does not hold {count} numbers")
    return values


def number(text: str) -> float:
    """A Fortran real: exponents with D, Q or without a letter are understood.

    Raises
    ------
    ValueError
        Where it is none.
    """
    if "_" in text:
        raise ValueError(text)
    try:
        return float(text)
    except ValueError:
        plain = text.strip().upper().translate(str.maketrans("DQ", "EE"))
        return float(plain if "E" in plain else _NO_LETTER.sub(r"E\1", plain))


def _value(cell: str, kind: type) -> int | float | str:
    if kind is str:
        return cell
    if not cell:
        return kind(0)
    value = number(cell)
    if kind is float:
        return value
    if not value.is_integer() or abs(value) > _LARGEST_INTEGER:
        raise ValueError(cell)
    return int(value)
