"""Tools of a ground vibration test: the suspension's check, and measured beside simulated shapes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from statorhom.errors import IdentificationError, InputFileError, RecordingError, SupportError
from statorhom.model.suspension import Cord, suspend
from statorhom.modes.mac_table import LEAST_MAC, mac_table
from statorhom.modes.plan_form import PlanFormName, name_plan_form, ordinal_labels
from statorhom.recordings.mode_shape import ModeShape
from statorhom.recordings.read import read_recording
from statorhom.recordings.recording import Recording
from statorhom.study import table_cells
from statorhom.study.csv_file import read_csv
from statorhom.study.message import input_error

if TYPE_CHECKING:
    import pandas as pd

_PLACE = ("x_mm", "y_mm", "z_mm")
_DIRECTION = ("dx", "dy", "dz")
_FEWEST_NODES = 3


def read_cords(path: Path) -> tuple[Cord, ...]:
    """Cords of a suspension from a CSV file.

    Columns x_mm, y_mm, z_mm and stiffness_n_per_m are required; length_mm makes a cord a pendulum, dx, dy, dz say
    where it leads (upwards, along z).

    Raises
    ------
    InputFileError
        One line with file, row, column and remedy.
    """
    required = (*_PLACE, "stiffness_n_per_m")
    _, rows = read_csv(path, known=(*required, "length_mm", *_DIRECTION), required=required)
    cords = []
    for row in rows:
        values = {
            column: (table_cells.number if column in _PLACE + _DIRECTION else table_cells.positive)(
                path, row.line, column, cell
            )
            for column, cell in row.cells.items()
        }
        empty = [column for column in required if values[column] is None]
        if empty:
            raise input_error(path, f"line {row.line}, column {empty[0]}", "is empty", "type a number")
        x, y, z = (1e-3 * (values[column] or 0.0) for column in _PLACE)
        dx, dy, dz = (values.get(column) or 0.0 for column in _DIRECTION)
        direction = (dx, dy, dz) if any((dx, dy, dz)) else (0.0, 0.0, 1.0)
        length = values.get("length_mm")
        cords.append(
            Cord(
                (x, y, z),
                values["stiffness_n_per_m"] or 0.0,
                direction,
                None if length is None else 1e-3 * length,
            )
        )
    return tuple(cords)


def check_suspension(
    path: Path, mass_kg: float, elastic_hz: float, inertia_kg_m2: Sequence[float] | None = None
) -> tuple[str, pd.DataFrame]:
    """Rigid-body modes on the cords of a file, and the verdict against the first elastic mode.

    Raises
    ------
    InputFileError, SupportError
        Where the file or the numbers are not those of a suspension.
    """
    import pandas as pd

    cords = read_cords(path)
    try:
        found = suspend(cords, mass_kg, inertia_kg_m2)
        verdict = found.verdict(elastic_hz)
    except SupportError as error:
        raise InputFileError(f"{path}: {error}") from None
    return verdict, pd.DataFrame({"motion": found.names, "frequency_hz": found.frequency_hz})


@dataclass(frozen=True)
class _Mode:
    """A mode's frequency and its motion at the common nodes, (nodes, 3)."""

    frequency_hz: float
    shape: np.ndarray


def compare_shapes(measured: Path, simulated: Path, least_mac: float = LEAST_MAC) -> pd.DataFrame:
    """Modes of two universal files, paired by the MAC at the nodes that both have.

    Returns
    -------
    DataFrame with measured_hz, simulated_hz, difference_percent (of the measured one, with its sign), mac, and the
    names of plates' and wings' shapes.

    Raises
    ------
    RecordingError
        Where a file holds no shapes or they have fewer than three nodes in common.
    """
    import pandas as pd

    files = [_with_shapes(path) for path in (measured, simulated)]
    nodes = sorted(set.intersection(*(set(shape.nodes) for file in files for shape in file.shapes)))
    if len(nodes) < _FEWEST_NODES:
        raise RecordingError(
            f"{simulated}: its shapes have {len(nodes)} nodes in common with those of {measured}; "
            "give both files the same node numbers"
        )
    first, second = (
        [_Mode(shape.frequency_hz, _at(shape, nodes)) for shape in file.shapes] for file in files
    )
    seen = _measured_directions(first)
    first, second = ([_Mode(one.frequency_hz, one.shape * seen) for one in side] for side in (first, second))
    names = [_names(file, nodes, side) for file, side in zip(files, (first, second), strict=True)]
    try:
        rows = mac_table(first, second, least_mac)
    except IdentificationError as error:
        raise RecordingError(f"{simulated}: {error}") from None
    table = pd.DataFrame(
        {
            "name": names[0][row.measured] if row.measured is not None else names[1][row.simulated or 0],
            "measured_hz": row.measured_hz,
            "simulated_hz": row.simulated_hz,
            "difference_percent": None if row.difference is None else 100 * row.difference,
            "mac": row.mac,
        }
        for row in rows
    )
    return table.astype({column: float for column in table.columns if column != "name"})


def _with_shapes(path: Path) -> Recording:
    recording = read_recording([path])
    if not recording.shapes:
        raise RecordingError(f"{path}: holds no mode shapes (dataset 55)")
    return recording


def _at(shape: ModeShape, nodes: Sequence[int]) -> np.ndarray:
    row = {node: i for i, node in enumerate(shape.nodes)}
    return np.asarray(shape.displacement[[row[node] for node in nodes]])


def _measured_directions(modes: Sequence[_Mode]) -> np.ndarray:
    """1 where a node was measured in a direction, else 0: what was not measured must not count against a MAC."""
    return np.any([mode.shape != 0 for mode in modes], axis=0).astype(float)


def _names(file: Recording, nodes: Sequence[int], modes: Sequence[_Mode]) -> tuple[str, ...]:
    places = {node.number: node.position for node in file.nodes}
    if not all(node in places for node in nodes):
        return ("",) * len(modes)
    points = np.array([places[node] for node in nodes])
    found: list[PlanFormName | None] = []
    for mode in modes:
        try:
            found.append(name_plan_form(points, mode.shape))
        except IdentificationError:
            found.append(None)
    return ordinal_labels(found)
