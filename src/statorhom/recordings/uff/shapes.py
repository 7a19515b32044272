"""Dataset 55, data at nodes: mode shapes."""

from __future__ import annotations

import math

import numpy as np

from statorhom.recordings.mode_shape import ModeShape
from statorhom.recordings.uff.records import Place, fields, reals

NORMAL_MODE, COMPLEX_FIRST_ORDER, COMPLEX_SECOND_ORDER = 2, 3, 7
_REAL, _COMPLEX = 2, 5
_DEFINITION = ((10, int),) * 6
_HEADER_LINES = 8
_VALUES_PER_LINE = 6
_MOST_VALUES = 9


def read_shape(place: Place, lines: list[str]) -> ModeShape | None:
    """Read a mode shape.

    Displacements are global Cartesian components, as the format says; rotations are left out.

    Parameters
    ----------
    place : Place
    lines : list of str
        Records of the dataset.

    Returns
    -------
    ModeShape or None
        None where the dataset holds something else than a mode's displacements.

    Raises
    ------
    RecordingError
    """
    if len(lines) < _HEADER_LINES:
        raise place.error(None, "ends within its header", "the file is truncated; export it again")
    _, analysis, _, _, data_type, per_node = fields(place, 7, lines[5], _DEFINITION)
    if analysis not in (NORMAL_MODE, COMPLEX_FIRST_ORDER, COMPLEX_SECOND_ORDER):
        return None
    if data_type not in (_REAL, _COMPLEX) or not 3 <= per_node <= _MOST_VALUES:
        return None
    frequency, damping = _pole(place, analysis, lines[7])
    width = per_node * (2 if data_type == _COMPLEX else 1)
    nodes, values = _data(place, lines[_HEADER_LINES:], width)
    complex_values = (
        values[:, 0::2] + 1j * values[:, 1::2] if data_type == _COMPLEX else values.astype(complex)
    )
    return ModeShape(frequency, damping, tuple(nodes), np.ascontiguousarray(complex_values[:, :3]))


def _pole(place: Place, analysis: int, text: str) -> tuple[float, float | None]:
    if analysis == NORMAL_MODE:
        frequency, _, viscous, hysteretic = reals(place, 9, text, 4)
        return frequency, viscous or hysteretic / 2 or None
    real, imaginary = reals(place, 9, text, 2)
    magnitude = math.hypot(real, imaginary)
    return magnitude / (2 * math.pi), (-real / magnitude if magnitude else None)


def _data(place: Place, lines: list[str], width: int) -> tuple[list[int], np.ndarray]:
    lines_per_node = 1 + -(-width // _VALUES_PER_LINE)
    nodes, rows = [], []
    for start in range(0, len(lines), lines_per_node):
        line = start + _HEADER_LINES + 2
        batch = lines[start : start + lines_per_node]
        if len(batch) < lines_per_node:
            raise place.error(line, "ends within a node", "the file is truncated; export it again")
        nodes.extend(fields(place, line, batch[0], ((10, int),)))
        rows.append(reals(place, line + 1, " ".join(batch[1:]), width))
    return nodes, np.array(rows, dtype=float).reshape(len(nodes), width)
