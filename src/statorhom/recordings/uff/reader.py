"""Universal files, read whole."""

from __future__ import annotations

import mmap
from collections import Counter, defaultdict
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np

from statorhom.recordings.frf_groups import frf_sets
from statorhom.recordings.message import recording_error
from statorhom.recordings.recording import Node, Recording
from statorhom.recordings.uff.blocks import Block, Buffer, find_blocks
from statorhom.recordings.uff.coordinate_systems import read_systems
from statorhom.recordings.uff.frfs import frfs
from statorhom.recordings.uff.function import Function, read_function
from statorhom.recordings.uff.function_header import COHERENCE, FRF, TIME_RESPONSE
from statorhom.recordings.uff.hits import hits
from statorhom.recordings.uff.nodes import Geometry, merge_nodes, read_nodes, read_trace_line
from statorhom.recordings.uff.shapes import read_shape
from statorhom.recordings.uff.units import Units, read_units
from statorhom.study.message import one_line

_NODES, _TRACE, _SHAPE, _FUNCTION, _HEADER, _UNITS, _SYSTEMS = (15, 2411), 82, 55, 58, 151, 164, 2420
_KNOWN = {*_NODES, _TRACE, _SHAPE, _FUNCTION, _HEADER, _UNITS, _SYSTEMS}


# what overflows in a damaged file is found by what is not finite afterwards
@np.errstate(over="ignore", invalid="ignore")
def read_uff(path: Path) -> Recording:
    """Read a universal file: FRFs, coherences, time records, mode shapes, nodes and trace lines.

    Datasets 15, 55, 58, 58b, 82, 151, 164, 2411 and 2420 are understood. Everything is converted to SI by
    dataset 164, mobilities and receptances to accelerances, directions to global unit vectors.

    Parameters
    ----------
    path : Path

    Returns
    -------
    Recording
        Its `remarks` say what was left out or tolerated.

    Raises
    ------
    RecordingError
        One line with file, dataset, line and remedy.
    """
    with _mapped(path) as data:
        blocks, remarks = find_blocks(path, data)
        by_kind = defaultdict(list)
        for block in blocks:
            by_kind[block.place.kind].append(block)
        unknown = Counter(block.place.kind for block in blocks if block.place.kind not in _KNOWN)
        remarks += [f"{count} datasets of type {kind} are ignored" for kind, count in sorted(unknown.items())]
        units = _units(path, by_kind[_UNITS], data)
        if not units.are_si:
            remarks.append("values are converted to SI from the file's own units")
        geometry, more = _geometry(by_kind, data, units)
        functions, others = _functions(by_kind[_FUNCTION], data)
        shapes = [read_shape(block.place, block.lines(data)) for block in by_kind[_SHAPE]]
        trace_lines = [
            line for block in by_kind[_TRACE] for line in read_trace_line(block.place, block.lines(data))
        ]
        name = by_kind[_HEADER][0].lines(data)[:1] if by_kind[_HEADER] else []
    found, of_frfs = frfs(functions, geometry, units)
    found_hits, of_hits = hits(functions, geometry, units)
    del functions
    sets, of_sets = frf_sets(found, str(path))
    return Recording(
        name=one_line("".join(name).strip()) or path.stem,
        frf_sets=sets,
        hits=tuple(found_hits),
        shapes=tuple(shape for shape in shapes if shape is not None),
        nodes=tuple(Node(number, node.position) for number, node in geometry.nodes.items()),
        trace_lines=tuple(trace_lines),
        remarks=tuple(map(one_line, [*remarks, *more, *others, *of_frfs, *of_hits, *of_sets])),
    )


@contextmanager
def _mapped(path: Path) -> Iterator[Buffer]:
    """A file's bytes, of which only what is looked at takes memory."""
    try:
        with path.open("rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as data:
            yield data
    except OSError as error:
        reason = error.strerror or "unknown reason"
        raise recording_error(
            path, "", f"cannot be read ({reason})", "check the path and permissions"
        ) from None
    except ValueError as error:
        if path.stat().st_size:
            raise
        raise recording_error(path, "", "is empty", "export the recording again") from error


def _units(path: Path, blocks: list[Block], data: Buffer) -> Units:
    if not blocks:
        raise recording_error(
            path, "", "has no units (dataset 164)", "export it with its unit system, which should be SI"
        )
    units = [read_units(block.place, block.lines(data)) for block in blocks]
    for block, other in zip(blocks, units, strict=True):
        if other != units[0]:
            raise block.place.error(
                None, "units differ from those of an earlier dataset 164", "keep one of them"
            )
    return units[0]


def _geometry(by_kind: dict[int, list[Block]], data: Buffer, units: Units) -> tuple[Geometry, list[str]]:
    systems = {}
    for block in by_kind[_SYSTEMS]:
        systems.update(read_systems(block.place, block.lines(data), units))
    nodes = [
        node
        for kind in _NODES
        for block in by_kind[kind]
        for node in read_nodes(block.place, block.lines(data), units)
    ]
    merged, remarks = merge_nodes(nodes)
    return Geometry(merged, systems), remarks


def _functions(blocks: list[Block], data: Buffer) -> tuple[list[Function], list[str]]:
    read, left_out = [], Counter[int]()
    for block in blocks:
        assert block.header is not None
        if block.header.kind in (TIME_RESPONSE, FRF, COHERENCE):
            read.append(read_function(block, data))
        else:
            left_out[block.header.kind] += 1
    return read, [f"{n} functions of type {kind} are ignored" for kind, n in sorted(left_out.items())]
