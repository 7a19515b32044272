"""Refuse results that no run can have written, before anything is drawn from them."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path

from pydantic import BaseModel

from statorhom.errors import ResultsError
from statorhom.results import Convergence, Results, Sensitivity
from statorhom.study.message import one_line


def check_results(results: Results, path: Path) -> None:
    """Check what the schema leaves open.

    Raises
    ------
    ResultsError
        For a number that is not finite, or a table whose rows and columns contradict each other.
    """
    for key, problem in _problems(results, ""):
        raise ResultsError(one_line(f"{path}: {key}: {problem}; delete the file and run the study again"))


def _problems(value: object, key: str) -> Iterator[tuple[str, str]]:
    if isinstance(value, float) and not math.isfinite(value):
        yield key, "a figure is not finite"
    if isinstance(value, Sensitivity) and not _rectangular(value):
        yield key, "values need a row per mode and a column per constant"
    if isinstance(value, Convergence) and not _drawable(value):
        yield key, "every mesh needs its degrees of freedom and its frequency"
    for name, part in _parts(value):
        yield from _problems(part, f"{key}.{name}".removeprefix("."))


def _parts(value: object) -> Iterator[tuple[str, object]]:
    if isinstance(value, BaseModel):
        yield from ((name, getattr(value, name)) for name in type(value).model_fields)
    elif isinstance(value, dict):
        yield from ((str(name), part) for name, part in value.items())
    elif isinstance(value, tuple):
        yield from ((str(i), part) for i, part in enumerate(value))


def _rectangular(table: Sensitivity) -> bool:
    return len(table.values) == len(table.modes) and all(
        len(row) == len(table.constants) for row in table.values
    )


def _drawable(series: Convergence) -> bool:
    sizes = len(series.dof) == len(series.frequency_hz) and all(n > 0 for n in series.dof)
    return sizes and series.extrapolated_hz > 0
