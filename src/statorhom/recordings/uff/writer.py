"""Universal files, written: units, coordinate systems, nodes, functions and mode shapes."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from pathlib import Path

import numpy as np

from statorhom.recordings.dof import Dof, Vector
from statorhom.recordings.frf_set import FrfSet
from statorhom.recordings.hit import Hit
from statorhom.recordings.message import recording_error
from statorhom.recordings.mode_shape import ModeShape
from statorhom.recordings.recording import Recording
from statorhom.recordings.uff.directions import (
    CARTESIAN_LABEL,
    SYSTEMS,
    direction_code,
    displacement_systems,
    positions,
)
from statorhom.recordings.uff.function_header import COHERENCE, FRF, TIME_RESPONSE
from statorhom.recordings.uff.function_writer import (
    ACCELERATION_AXIS,
    FORCE_AXIS,
    FREQUENCY_AXIS,
    NO_AXIS,
    TIME_AXIS,
    DofCode,
    WrittenFunction,
)
from statorhom.recordings.uff.shapes import COMPLEX_FIRST_ORDER, NORMAL_MODE
from statorhom.study.atomic import write_bytes
from statorhom.study.message import one_line

_NOWHERE = DofCode(0, 0)
_LONGEST_LINE = 80
_LARGEST_NODE = 10**9
_COLOUR = 11


def write_uff(path: Path, recording: Recording, binary: bool = True) -> None:
    """Write a recording: datasets 151, 164 (SI), 2420, 2411, 82, 58 or 58b, and 55.

    Values keep double precision (in text 13 digits), evenly spaced axes and mode shapes six digits.

    Parameters
    ----------
    path : Path
        Replaced only when complete.
    recording : Recording
        Remarks are not written.
    binary : bool
        Whether functions are written as 58b.

    Raises
    ------
    RecordingError
        Where a node lies at two places or has a direction that the format cannot name.
    ResultsError
        Where the file cannot be written.
    """
    dofs = list(_dofs(recording))
    systems = displacement_systems(path, dofs)
    places = positions(
        path, [*((n.number, n.position) for n in recording.nodes), *((d.node, d.position) for d in dofs)]
    )
    for node in {*places, *systems}:
        if not 0 <= node < _LARGEST_NODE:
            raise recording_error(path, f"node {node}", "has a number that does not fit", "use 0 … 999999999")
    parts = [_dataset(151, _header(recording.name)), _dataset(164, _units()), _dataset(2420, _systems())]
    if places:
        parts.append(_dataset(2411, _nodes(places, systems)))
    parts += [_dataset(82, _trace(i, line)) for i, line in enumerate(recording.trace_lines, start=1)]
    for frf_set in recording.frf_sets:
        parts += [function.encoded(binary) for function in _frf_functions(frf_set, systems)]
    for hit in recording.hits:
        parts += [function.encoded(binary) for function in _hit_functions(hit, systems)]
    parts += [_dataset(55, _shape(number, shape)) for number, shape in enumerate(recording.shapes, start=1)]
    write_bytes(path, b"".join(parts))


def _dofs(recording: Recording) -> Iterator[Dof]:
    for frf_set in recording.frf_sets:
        yield from frf_set.responses
        yield from frf_set.references
    for hit in recording.hits:
        yield hit.reference
        yield from hit.responses


def _dataset(kind: int, lines: Iterable[str]) -> bytes:
    delimiter = f"{-1:6d}"
    return "\n".join([delimiter, f"{kind:6d}", *lines, delimiter, ""]).encode("ascii", "replace")


def _header(name: str) -> list[str]:
    # the dates are left open, so that the same recording gives the same file
    dates = f"{'NONE':10s}{'NONE':10s}"
    return [
        one_line(name)[:_LONGEST_LINE].strip() or "NONE",
        "modal test",
        "NONE",
        f"{dates}{0:10d}{0:10d}{0:10d}",
        dates,
        "statorhom",
        dates,
    ]


def _units() -> list[str]:
    return [f"{1:10d}{'SI':20s}{2:10d}", _doubles((1.0, 1.0, 1.0)), _doubles((273.15,))]


def _systems() -> Iterator[str]:
    yield f"{1:10d}"
    yield "structure"
    for label, system in SYSTEMS.items():
        yield f"{label:10d}{system.kind:10d}{8:10d}"
        yield "global" if label == CARTESIAN_LABEL else "machine"
        yield from map(_doubles, (*system.axes, system.origin))


def _nodes(places: dict[int, Vector], systems: dict[int, int]) -> Iterator[str]:
    for node, position in places.items():
        yield f"{node:10d}{CARTESIAN_LABEL:10d}{systems.get(node, CARTESIAN_LABEL):10d}{_COLOUR:10d}"
        yield _doubles(position)


def _doubles(values: Iterable[float]) -> str:
    return "".join(f"{value:25.16e}" for value in values).replace("e", "D")


def _trace(number: int, nodes: tuple[int, ...]) -> Iterator[str]:
    yield f"{number:10d}{len(nodes):10d}{_COLOUR:10d}"
    yield "NONE"
    for start in range(0, len(nodes), 8):
        yield "".join(f"{node:10d}" for node in nodes[start : start + 8])


def _code(dof: Dof, systems: dict[int, int]) -> DofCode:
    return DofCode(dof.node, direction_code(dof, systems[dof.node]) or 0)


def _frf_functions(frf_set: FrfSet, systems: dict[int, int]) -> Iterator[WrittenFunction]:
    frequency = frf_set.frequency_hz
    for row in range(len(frf_set)):
        pair = _code(frf_set.responses[row], systems), _code(frf_set.references[row], systems)
        axes = (FREQUENCY_AXIS, ACCELERATION_AXIS, FORCE_AXIS)
        yield WrittenFunction(FRF, 0, *pair, frequency, frf_set.accelerance[row], axes)
        if frf_set.coherence is not None and not np.isnan(frf_set.coherence[row]).all():
            axes = (FREQUENCY_AXIS, NO_AXIS, NO_AXIS)
            yield WrittenFunction(COHERENCE, 0, *pair, frequency, frf_set.coherence[row], axes)


def _hit_functions(hit: Hit, systems: dict[int, int]) -> Iterator[WrittenFunction]:
    times = np.arange(len(hit.force_n)) / hit.sample_rate_hz
    hammer = _code(hit.reference, systems)
    axes = (TIME_AXIS, FORCE_AXIS, NO_AXIS)
    yield WrittenFunction(TIME_RESPONSE, hit.number, hammer, _NOWHERE, times, hit.force_n, axes)
    for dof, record in zip(hit.responses, hit.acceleration_m_s2, strict=True):
        axes = (TIME_AXIS, ACCELERATION_AXIS, NO_AXIS)
        yield WrittenFunction(TIME_RESPONSE, hit.number, _code(dof, systems), hammer, times, record, axes)


def _shape(number: int, shape: ModeShape) -> Iterator[str]:
    yield from ["NONE"] * 5
    has_damping = shape.damping_ratio is not None
    analysis = COMPLEX_FIRST_ORDER if has_damping else NORMAL_MODE
    # structural, 3 translations, displacement, complex, 3 values a node
    yield "".join(f"{value:10d}" for value in (1, analysis, 2, 8, 5, 3))
    yield "".join(f"{value:10d}" for value in (2, 6 if has_damping else 4, 1, number))
    yield _reals(_pole(shape) if has_damping else (shape.frequency_hz, 0.0, 0.0, 0.0))
    for node, vector in zip(shape.nodes, shape.displacement, strict=True):
        yield f"{node:10d}"
        yield _reals(np.column_stack([vector.real, vector.imag]).ravel())


def _pole(shape: ModeShape) -> tuple[float, ...]:
    assert shape.damping_ratio is not None
    omega = 2 * math.pi * shape.frequency_hz
    damped = omega * math.sqrt(max(1 - shape.damping_ratio**2, 0.0))
    return (-shape.damping_ratio * omega, damped, 0.0, 0.0, 0.0, 0.0)


def _reals(values: Iterable[float]) -> str:
    return "".join(f"{value:13.5e}" for value in values)
