"""Numeric arrays of MAT files, versions 5 to 7.2.

An own reader of this small part of the format (The MathWorks, MAT-File Format), because general ones crash the
whole program on some damaged files.
"""

from __future__ import annotations

import math
import struct
import zlib
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from statorhom.recordings.message import recording_error

_HEADER_BYTES, _TAG_BYTES = 128, 8
_BYTE_ORDERS = {b"IM": "<", b"MI": ">"}
_MATRIX, _COMPRESSED = 14, 15
_TYPES = {1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 9: "f8", 12: "i8", 13: "u8"}
# double, single and all integers; text, cells and structures are none of ours
_NUMERIC_CLASSES = range(6, 16)
_COMPLEX_FLAG = 0x0800
_LARGEST_ARRAY_BYTES = 2**32


def read_mat_arrays(path: Path, names: tuple[str, ...]) -> dict[str, np.ndarray]:
    """The numeric arrays of some names.

    Parameters
    ----------
    path : Path
    names : tuple of str
        What to read; everything else is passed over.

    Returns
    -------
    dict of str to array
        Real or complex, double precision, as MATLAB shows them (at least two dimensions).

    Raises
    ------
    RecordingError
    """
    try:
        content = path.read_bytes()
        order = _BYTE_ORDERS.get(content[_HEADER_BYTES - 2 : _HEADER_BYTES])
        if order is None:
            raise ValueError("its head is not that of MAT files of versions 5 to 7.2")
        arrays: dict[str, np.ndarray] = {}
        for kind, body in _elements(content[_HEADER_BYTES:], order):
            inner = _inflated(body, order) if kind == _COMPRESSED else (kind, body)
            if inner[0] == _MATRIX:
                arrays.update(_matrix(inner[1], order, names))
    except OSError as error:
        raise recording_error(
            path, "", f"cannot be read ({error.strerror})", "check its permissions"
        ) from None
    except (ValueError, struct.error, zlib.error) as error:
        raise recording_error(path, "", f"is no sound MAT file ({error})", "save it again with -v7") from None
    return arrays


def _elements(content: bytes, order: str) -> Iterator[tuple[int, bytes]]:
    """Type and data of one element after the other."""
    position = 0
    while position + _TAG_BYTES <= len(content):
        kind, size = struct.unpack_from(f"{order}2I", content, position)
        start = position + _TAG_BYTES
        if kind >> 16:
            # a small element holds up to four bytes in its tag
            kind, size, start = kind & 0xFFFF, kind >> 16, position + 4
        if start + size > len(content):
            raise ValueError("it ends within an array")
        yield kind, content[start : start + size]
        # all but compressed ones are padded to eight bytes
        padding = 0 if kind == _COMPRESSED else -size % 8 if start != position + 4 else 4 - size
        position = start + size + padding


def _inflated(body: bytes, order: str) -> tuple[int, bytes]:
    inflator = zlib.decompressobj()
    head = inflator.decompress(body, _TAG_BYTES)
    kind, size = struct.unpack(f"{order}2I", head)
    if size > _LARGEST_ARRAY_BYTES:
        raise ValueError("an array is larger than the format allows")
    rest = inflator.decompress(inflator.unconsumed_tail, max(size, 1))
    if len(rest) < size:
        raise ValueError("it ends within an array")
    return kind, rest


def _matrix(body: bytes, order: str, names: tuple[str, ...]) -> dict[str, np.ndarray]:
    parts = list(_elements(body, order))
    if len(parts) < 4:
        return {}
    (_, flag_bytes), (_, shape_bytes), (_, name), (kind, real), *rest = parts
    flags = struct.unpack_from(f"{order}I", flag_bytes)[0]
    text = name.decode("latin-1")
    if text not in names or flags & 0xFF not in _NUMERIC_CLASSES:
        return {}
    shape = [int(length) for length in _numbers(5, shape_bytes, order)]
    array = _numbers(kind, real, order)
    if flags & _COMPLEX_FLAG:
        if not rest:
            raise ValueError("a complex array has no imaginary part")
        imaginary = _numbers(*rest[0], order)
        if len(imaginary) != len(array):
            raise ValueError("real and imaginary parts differ in size")
        array = array + 1j * imaginary
    if min(shape, default=0) < 0 or math.prod(shape) != len(array):
        raise ValueError("dimensions contradict the size of an array")
    return {text: array.reshape(shape, order="F")}


def _numbers(kind: int, data: bytes, order: str) -> np.ndarray:
    if kind not in _TYPES:
        raise ValueError("an array is stored in an unknown way")
    return np.frombuffer(data, dtype=f"{order}{_TYPES[kind]}").astype(float)
