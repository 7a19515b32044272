"""Where the datasets of a universal file begin and end."""

from __future__ import annotations

import mmap
import re
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from statorhom.recordings.message import recording_error
from statorhom.recordings.uff.binary_values import point_types, read_byte_order
from statorhom.recordings.uff.function_header import HEADER_RECORDS, FunctionHeader, read_header
from statorhom.recordings.uff.records import Place
from statorhom.study.message import quoted

Buffer = bytes | mmap.mmap

_OPENING = re.compile(rb"(?:\xef\xbb\xbf)?\s*-1[ \t]*\r?\n")
_CLOSING = re.compile(rb"\n[ \t]*-1[ \t]*\r?(?:\n|\Z)")
# some programs end the values of a binary dataset with a line break, others do not
_CLOSING_BINARY = re.compile(rb"\r?\n?[ \t]*-1[ \t]*\r?(?:\n|\Z)")
_TYPE = re.compile(r"\s*(\d{1,6})(?:\s*(b)(.*)|\s.*)?$", re.IGNORECASE)
_FUNCTION = 58


@dataclass(frozen=True)
class Block:
    """One dataset.

    Attributes
    ----------
    place : Place
    start, end : int
        Bytes of its records after the line with the type; of a function: of its values.
    header : FunctionHeader or None
        Of datasets of type 58.
    point : dtype or None
        How a point of a function is stored; None where it is text.
    """

    place: Place
    start: int
    end: int
    header: FunctionHeader | None = None
    point: np.dtype | None = None

    def lines(self, data: Buffer) -> list[str]:
        """Its records."""
        return _decoded(data[self.start : self.end]).splitlines()


def find_blocks(path: Path, data: Buffer) -> tuple[list[Block], list[str]]:
    """All datasets of a file.

    Parameters
    ----------
    path : Path
    data : bytes or memory map

    Returns
    -------
    blocks : list of Block
    remarks : list of str
        Dialects that were tolerated.

    Raises
    ------
    RecordingError
        Where the file is no universal file or a dataset has no type, header or end.
    """
    opening = _OPENING.match(data)
    if opening is None:
        raise recording_error(
            path, "", "is no universal file, its first line is not -1", "export it in universal format"
        )
    blocks: list[Block] = []
    position = opening.end()
    while position < len(data):
        type_line, start = _line(data, position)
        if not type_line.strip() and not data[start:].strip():
            break
        block, after = _block(path, len(blocks) + 1, data, type_line, start)
        blocks.append(block)
        if after is None:
            return blocks, ["the last dataset is not closed by -1"]
        # where a delimiter is missing, the one that is there both closes and opens
        opening = _OPENING.match(data, after)
        position = opening.end() if opening else after
    return blocks, []


def _block(path: Path, number: int, data: Buffer, type_line: str, start: int) -> tuple[Block, int | None]:
    """A dataset and where the next one's delimiter begins; None where it is not closed."""
    found = _TYPE.match(type_line)
    if found is None:
        raise recording_error(
            path,
            f"dataset {number}",
            f"{quoted(type_line.strip())} is no type of a dataset",
            "the file is damaged; export it again",
        )
    place = Place(path, number, int(found[1]))
    header = None
    if place.kind == _FUNCTION:
        records = []
        for _ in range(HEADER_RECORDS):
            if start >= len(data):
                raise place.error(None, "ends within its header", "the file is truncated; export it again")
            record, start = _line(data, start)
            records.append(record)
        header = read_header(place, records)
    block = Block(place, start, start, header)
    if header is not None and found[2]:
        return _binary_block(block, header, found[3], data)
    closing = _CLOSING.search(data, max(start - 1, 0))
    if closing is None:
        return replace(block, end=len(data)), None
    return replace(block, end=closing.start() + 1), closing.end()


def _binary_block(block: Block, header: FunctionHeader, form: str, data: Buffer) -> tuple[Block, int]:
    """A binary function ends where its values end: what looks like a delimiter may be a number."""
    for point in point_types(header, read_byte_order(block.place, form)):
        end = block.start + header.count * point.itemsize
        closing = _CLOSING_BINARY.match(data, end) if end <= len(data) else None
        if closing is not None:
            return replace(block, end=end, point=point), closing.end()
    raise block.place.error(
        None,
        f"its {header.count} binary values are not followed by -1",
        "the file is truncated, or was copied as text; export or copy it again",
    )


def _line(data: Buffer, start: int) -> tuple[str, int]:
    """A line without its end, and where the next one begins."""
    end = data.find(b"\n", start)
    end = len(data) if end < 0 else end
    return _decoded(data[start:end]).rstrip("\r"), end + 1


def _decoded(text: bytes) -> str:
    try:
        return text.decode("utf-8")
    except UnicodeDecodeError:
        return text.decode("latin-1")
