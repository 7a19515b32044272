"""Dataset 58: abscissae and values of a function."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from statorhom.recordings.uff.blocks import Block, Buffer
from statorhom.recordings.uff.function_header import HEADER_RECORDS, FunctionHeader
from statorhom.recordings.uff.numbers import read_numbers
from statorhom.recordings.uff.records import Place

_SINGLE, _DOUBLE = 13, 20
_FIRST_LINE_OF_VALUES = HEADER_RECORDS + 2


@dataclass(frozen=True)
class Function:
    """A function as the file holds it, in the file's units.

    Attributes
    ----------
    place : Place
    header : FunctionHeader
    abscissa : array, shape (points,)
    values : real or complex array, shape (points,)
    """

    place: Place
    header: FunctionHeader
    abscissa: np.ndarray
    values: np.ndarray


def read_function(block: Block, data: Buffer) -> Function:
    """Read the values of a function.

    Parameters
    ----------
    block : Block
        A dataset of type 58.
    data : bytes or memory map

    Raises
    ------
    RecordingError
    """
    header = block.header
    assert header is not None
    abscissa, ordinates = _binary(block, data) if block.point is not None else _text(block, data, header)
    values = ordinates.view(np.result_type(ordinates, np.complex64)) if header.is_complex else ordinates
    if abscissa is None:
        abscissa = header.start + header.increment * np.arange(header.count)
    return Function(block.place, header, np.asarray(abscissa, dtype=float), values.reshape(header.count))


def _binary(block: Block, data: Buffer) -> tuple[np.ndarray | None, np.ndarray]:
    points = np.frombuffer(data[block.start : block.end], dtype=block.point)
    ordinates = np.ascontiguousarray(points["y"], dtype=points["y"].dtype.newbyteorder("="))
    return (points["x"] if "x" in (points.dtype.names or ()) else None), ordinates


def _text(block: Block, data: Buffer, header: FunctionHeader) -> tuple[np.ndarray | None, np.ndarray]:
    per_point = header.values_per_point
    body = data[block.start : block.end]
    if header.count * per_point > len(body):
        raise block.place.error(
            8, f"promises {header.count} values, but the file ends before", "export or copy the file again"
        )
    numbers = read_numbers(
        block.place, _FIRST_LINE_OF_VALUES, body, header.count * per_point, _widths(header)
    ).reshape(header.count, per_point)
    if header.is_even:
        return None, numbers
    return numbers[:, 0], np.ascontiguousarray(numbers[:, 1:])


def _widths(header: FunctionHeader) -> tuple[int, ...]:
    """Columns of a full line."""
    if not header.is_double:
        return (_SINGLE,) * 6
    if header.is_even:
        return (_DOUBLE,) * 4
    return (_SINGLE, _DOUBLE, _DOUBLE) if header.is_complex else (_SINGLE, _DOUBLE) * 2
