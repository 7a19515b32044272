"""CSV files with a header, comments and known columns."""

from __future__ import annotations

import csv
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from statorhom.study.message import input_error, one_line, quoted
from statorhom.study.nearest import hint
from statorhom.study.text_file import read_text


@dataclass(frozen=True)
class Row:
    """One data row: its line in the file (from 1) and its cells by column, stripped."""

    line: int
    cells: Mapping[str, str]


def read_csv(path: Path, known: tuple[str, ...], required: tuple[str, ...]) -> tuple[list[str], list[Row]]:
    """Read a table.

    Parameters
    ----------
    path : Path
        The file; lines that begin with # and empty lines are skipped.
    known, required : tuple of str
        Columns that may and that must occur, in any order.

    Returns
    -------
    header : list of str
    rows : list of Row
        At least one.

    Raises
    ------
    InputFileError
        One line with file, line and remedy.
    """
    lines = [
        (number, text)
        for number, text in enumerate(read_text(path).split("\n"), start=1)
        if text.strip() and not text.lstrip().startswith("#")
    ]
    if not lines:
        raise input_error(
            path, "", "is empty", f"write a header with {', '.join(required)} and one row per mode"
        )
    header = _header(path, *lines[0], known, required)
    rows = [_row(path, number, text, header) for number, text in lines[1:]]
    if not rows:
        raise input_error(path, "", "has a header but no rows", "add one row per mode")
    return header, rows


def _header(path: Path, line: int, text: str, known: tuple[str, ...], required: tuple[str, ...]) -> list[str]:
    where = f"line {line}"
    header = _cells(path, line, text)
    if len(header) == 1 and (";" in text or "\t" in text):
        raise input_error(path, where, "columns are not separated by commas", "save the table with commas")
    for column in header:
        if column not in known:
            raise input_error(path, where, f"unknown column {quoted(column)}", hint(column, known))
        if header.count(column) > 1:
            raise input_error(path, where, f"column {column} occurs twice", "delete one of the two")
    for column in required:
        if column not in header:
            raise input_error(
                path, where, f"column {column} is missing", "add it (the first line is the header)"
            )
    return header


def _row(path: Path, line: int, text: str, header: list[str]) -> Row:
    cells = _cells(path, line, text)
    if len(cells) != len(header):
        raise input_error(
            path,
            f"line {line}",
            f"has {len(cells)} cells, but the header has {len(header)}",
            "separate cells by single commas and write decimals with a point",
        )
    return Row(line, dict(zip(header, cells, strict=True)))


def _cells(path: Path, line: int, text: str) -> list[str]:
    try:
        # line by line, so that a stray quote cannot swallow the rest of the file
        [cells] = csv.reader([text], strict=True)
    except csv.Error as error:
        raise input_error(
            path, f"line {line}", f"is not CSV ({one_line(str(error))})", "remove stray quotes"
        ) from None
    return [cell.strip() for cell in cells]
