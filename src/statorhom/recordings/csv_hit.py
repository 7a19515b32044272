"""Hits in CSV files: one hit per file.

Columns: `time_s` (or the study's `sample_rate_hz`), `force_n` and `acceleration_m_s2`; with several accelerometers
`acceleration_NODE_m_s2` each.
"""

from __future__ import annotations

import re

import numpy as np

from statorhom.recordings.hit import Hit
from statorhom.recordings.number_table import NumberTable
from statorhom.recordings.placement import Placement

FORCE = "force_n"
_TIME = "time_s"
_ACCELERATION = re.compile(r"acceleration(?:_(\d{1,9}))?_m_s2")
# of the sampling interval, for rounded times
_EVEN = 0.05


def read_csv_hit(table: NumberTable, placement: Placement, number: int) -> Hit:
    """The hit of a table.

    Parameters
    ----------
    table : NumberTable
    placement : Placement
        Points, direction and, without a column time_s, the sample rate.
    number : int
        Of the hit.

    Raises
    ------
    RecordingError
    """
    table.require((FORCE,), (_TIME, FORCE, "acceleration_m_s2"), _ACCELERATION.fullmatch)
    found = [(name, match) for name in table.columns if (match := _ACCELERATION.fullmatch(name))]
    if not found:
        raise table.error("", "column acceleration_m_s2 is missing", "add the accelerometer's samples")
    nodes = [match[1] for _, match in found]
    records = [_finite(table, name) for name, _ in found]
    return Hit(
        number=number,
        sample_rate_hz=_sample_rate(table, placement),
        force_n=_finite(table, FORCE),
        acceleration_m_s2=np.array(records),
        reference=placement.hammer(),
        responses=tuple(placement.response(int(node)) if node else placement.response() for node in nodes),
        source=str(table.path),
    )


def _finite(table: NumberTable, column: str) -> np.ndarray:
    values = table.numbers(column)
    wrong = np.flatnonzero(~np.isfinite(values))
    if len(wrong):
        raise table.error(
            f"row {wrong[0] + 1}, column {column}",
            "is not a number",
            "export the record again or delete the hit",
        )
    return values


def _sample_rate(table: NumberTable, placement: Placement) -> float:
    if _TIME not in table.columns:
        if placement.sample_rate_hz is None:
            raise table.error("", "has no column time_s", "add it, or sample_rate_hz to the study's test")
        return placement.sample_rate_hz
    times = _finite(table, _TIME)
    if len(times) < 2:
        raise table.error("column time_s", "has a single sample", "export the whole record")
    steps = np.diff(times)
    step = float(times[-1] - times[0]) / len(steps)
    if not 0 < step < np.inf or np.max(np.abs(steps - step)) > _EVEN * step + _rounding(times):
        raise table.error(
            "column time_s", "is not evenly spaced", "export evenly sampled records, in seconds"
        )
    rate = 1.0 / step
    if placement.sample_rate_hz is not None and abs(rate / placement.sample_rate_hz - 1) > _EVEN:
        raise table.error(
            "column time_s",
            f"has {rate:.6g} samples per second, but sample_rate_hz is {placement.sample_rate_hz:.6g}",
            "correct one of them",
        )
    return rate


def _rounding(times: np.ndarray) -> float:
    """What printing with six digits may do to the difference of two times."""
    return 1e-5 * float(np.max(np.abs(times)))
