"""Many numbers of an ASCII dataset at once."""

from __future__ import annotations

import warnings

import numpy as np

from statorhom.recordings.uff.records import Place, number
from statorhom.study.message import quoted

_FORTRAN_EXPONENTS = bytes.maketrans(b"dDqQ", b"eEEE")


def read_numbers(
    place: Place, first_line: int, body: bytes, count: int, widths: tuple[int, ...]
) -> np.ndarray:
    """Numbers in fixed columns.

    Parameters
    ----------
    place : Place
    first_line : int
        Line of the dataset at which they begin, for messages.
    body : bytes
        The lines.
    count : int
        How many are promised; blank padding of the last line may follow as zeros.
    widths : tuple of int
        Width of each column of a full line.

    Returns
    -------
    array, shape (count,)

    Raises
    ------
    RecordingError
        Where a number is none, or where there are fewer or more.
    """
    values = _separated_by_blanks(body)
    if values is None or len(values) != count:
        values = np.array(_in_columns(place, first_line, body, widths))
    if not count <= len(values) < count + len(widths):
        raise place.error(
            None,
            f"holds {len(values)} numbers, but promises {count}",
            "the file is truncated or damaged; export it again",
        )
    return values[:count]


def _separated_by_blanks(body: bytes) -> np.ndarray | None:
    """All numbers at once; None where one is not understood this way."""
    # numpy 1.26 only warns where it stops at what is no number
    with warnings.catch_warnings():
        warnings.simplefilter("error", DeprecationWarning)
        try:
            return np.fromstring(body, sep=" ")
        except (ValueError, DeprecationWarning):
            pass
        try:
            return np.fromstring(body.translate(_FORTRAN_EXPONENTS), sep=" ")
        except (ValueError, DeprecationWarning):
            return None


def _in_columns(place: Place, first_line: int, body: bytes, widths: tuple[int, ...]) -> list[float]:
    values: list[float] = []
    for offset, line in enumerate(body.decode("latin-1").splitlines()):
        start = 0
        for width in widths:
            cell = line[start : start + width].strip()
            start += width
            if not cell:
                continue
            try:
                values.append(number(cell))
            except ValueError:
                raise place.error(
                    first_line + offset, f"{quoted(cell)} is not a number", "export the file again"
                ) from None
    return values
