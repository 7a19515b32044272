"""FRFs in CSV files, read and written.

A row holds one frequency of one FRF: `frequency_hz` and the accelerance in (m/s²)/N, either `real` and `imag` or
`amplitude` and `phase_deg`; optionally `coherence`. In the long form `response_node`, `response_direction`,
`reference_node`, `reference_direction` name the pair (directions x, y, z, r, theta with a sign) and
`response_x_mm` … `reference_z_mm` say where the points lie. Without these columns the file holds one FRF, and the
study says where it was measured.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd

from statorhom.recordings.dof import Dof
from statorhom.recordings.frf_groups import Frf
from statorhom.recordings.frf_set import FrfSet
from statorhom.recordings.message import recording_error
from statorhom.recordings.named_direction import DIRECTIONS, direction_name, direction_vector
from statorhom.recordings.number_table import NumberTable
from statorhom.recordings.placement import Placement
from statorhom.study.atomic import write_text
from statorhom.study.message import quoted

ENDS = ("response", "reference")
_POINTS = tuple(f"{end}_{axis}_mm" for end in ENDS for axis in "xyz")
_PAIR = tuple(f"{end}_{what}" for end in ENDS for what in ("node", "direction"))
_CARTESIAN, _POLAR = ("real", "imag"), ("amplitude", "phase_deg")
_COLUMNS = ("frequency_hz", *_CARTESIAN, *_POLAR, "coherence", *_PAIR, *_POINTS)
_MM = 1e-3
_LARGEST_NODE = 10**9


def read_csv_frfs(table: NumberTable, placement: Placement) -> list[Frf]:
    """FRFs of a table.

    Parameters
    ----------
    table : NumberTable
    placement : Placement
        Points and direction of the single FRF of a table that names none.

    Returns
    -------
    list of Frf

    Raises
    ------
    RecordingError
    """
    values = _POLAR if "amplitude" in table.columns else _CARTESIAN
    is_long = any(column in table.columns for column in _PAIR)
    table.require(("frequency_hz", *values, *(_PAIR if is_long else ())), _COLUMNS, lambda _: False)
    frequency = table.numbers("frequency_hz")
    first, second = (table.numbers(column) for column in values)
    with np.errstate(invalid="ignore"):
        accelerance = first * np.exp(1j * np.radians(second)) if values == _POLAR else first + 1j * second
    coherence = table.numbers("coherence") if "coherence" in table.columns else None
    found = []
    for rows in _rows_of_pairs(table) if is_long else [np.arange(len(frequency))]:
        _check_frequencies(table, frequency[rows], int(rows[0]))
        response, reference = (
            (_dof(table, end, int(rows[0])) for end in ENDS)
            if is_long
            else (placement.response(), placement.hammer())
        )
        own_coherence = None if coherence is None else coherence[rows]
        found.append(Frf(response, reference, frequency[rows], accelerance[rows], own_coherence))
    return found


def write_csv_frf(path: Path, frf_sets: tuple[FrfSet, ...]) -> None:
    """Write FRFs in the long form, with all digits.

    Parameters
    ----------
    path : Path
    frf_sets : tuple of FrfSet

    Raises
    ------
    RecordingError
        Where a direction has no name.
    ResultsError
        Where the file cannot be written.
    """
    ends = [(frf_set, row) for frf_set in frf_sets for row in range(len(frf_set))]
    if not ends:
        raise recording_error(path, "", "would hold no FRF", "give at least one set with one FRF")
    has_coherence = any(frf_set.coherence is not None for frf_set in frf_sets)
    header = ("frequency_hz", *_CARTESIAN, *(("coherence",) if has_coherence else ()), *_PAIR, *_POINTS)
    lines = [",".join(header)]
    for frf_set, row in ends:
        constant = ",".join(_pair_cells(path, frf_set.responses[row], frf_set.references[row]))
        columns = [frf_set.frequency_hz, frf_set.accelerance[row].real, frf_set.accelerance[row].imag]
        if has_coherence:
            columns.append(
                np.full(len(columns[0]), np.nan) if frf_set.coherence is None else frf_set.coherence[row]
            )
        cells = zip(*(column.tolist() for column in columns), strict=True)
        lines += [f"{','.join(map(repr, line))},{constant}" for line in cells]
    write_text(path, "\n".join([*lines, ""]))


def _rows_of_pairs(table: NumberTable) -> list[np.ndarray]:
    """Rows of every pair, in the order in which the pairs occur."""
    cells = [pd.factorize(table.frame[column], use_na_sentinel=False)[0] for column in _PAIR]
    _, first, pair = np.unique(np.column_stack(cells), axis=0, return_index=True, return_inverse=True)
    rows = np.split(np.argsort(pair.ravel(), kind="stable"), np.cumsum(np.bincount(pair.ravel()))[:-1])
    return [rows[index] for index in np.argsort(first)]


def _check_frequencies(table: NumberTable, frequency: np.ndarray, row: int) -> None:
    if not np.isfinite(frequency).all() or frequency[0] < 0 or (np.diff(frequency) <= 0).any():
        raise table.error(
            f"FRF of row {row + 1}, column frequency_hz",
            "frequencies do not ascend from 0 or above",
            "sort the rows of each FRF, and keep one measurement of a pair in a file",
        )


def _dof(table: NumberTable, end: str, row: int) -> Dof:
    node = table.numbers(f"{end}_node")[row]
    if not (node.is_integer() and 0 <= node < _LARGEST_NODE):
        raise table.error(
            f"row {row + 1}, column {end}_node", "is no whole number from 0", "number the points"
        )
    position = None
    columns = [f"{end}_{axis}_mm" for axis in "xyz"]
    if any(column in table.columns for column in columns):
        table.require(columns, _COLUMNS, lambda _: False)
        x, y, z = (float(table.numbers(column)[row]) * _MM for column in columns)
        position = (x, y, z) if np.isfinite((x, y, z)).all() else None
    name = table.frame[f"{end}_direction"].iloc[row]
    if pd.isna(name):
        return Dof(int(node), position)
    try:
        return Dof(int(node), position, direction_vector(str(name).strip(), position))
    except ValueError:
        raise table.error(
            f"row {row + 1}, column {end}_direction",
            f"{quoted(str(name))} is no direction",
            f"use {', '.join(DIRECTIONS)}, with a sign where it is reversed",
        ) from None


def _pair_cells(path: Path, *ends: Dof) -> list[str]:
    """Cells of the columns that name the pair, and of those that say where it lies."""
    pair, points = [], []
    for dof in ends:
        name = direction_name(dof)
        if name is None:
            raise recording_error(
                path,
                f"node {dof.node}",
                "has a direction that is none of x, y, z, r and theta",
                "write a universal file, or resolve the direction first",
            )
        pair += [str(dof.node), name]
        points += ["", "", ""] if dof.position is None else [repr(p / _MM) for p in dof.position]
    return pair + points
