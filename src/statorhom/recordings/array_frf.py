"""FRFs in HDF5 and MAT files: named arrays.

`frequency_hz` (lines), `accelerance` (FRFs × lines, complex, (m/s²)/N), `response_node` and `reference_node` (FRFs);
optionally `response_mm`, `reference_mm` (FRFs × 3, points), `response_direction`, `reference_direction` (FRFs × 3,
Cartesian unit vectors) and `coherence` (FRFs × lines). What belongs to the reference may stand once for all FRFs.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from statorhom.recordings.dof import Dof, Vector
from statorhom.recordings.frf_groups import Frf
from statorhom.recordings.message import recording_error
from statorhom.study.message import quoted

REQUIRED = ("frequency_hz", "accelerance", "response_node", "reference_node")
NAMES = (
    *REQUIRED,
    *("response_mm", "reference_mm", "response_direction", "reference_direction", "coherence"),
)
_MM = 1e-3
_UNIT = 1e-3
_LARGEST_NODE = 10**9

Arrays = Mapping[str, np.ndarray]


def frfs_of_arrays(path: Path, arrays: Arrays) -> list[Frf]:
    """FRFs from named arrays.

    Parameters
    ----------
    path : Path
        Their file, for messages.
    arrays : mapping of str to array

    Raises
    ------
    RecordingError
    """
    for name in REQUIRED:
        if name not in arrays:
            raise recording_error(path, name, "is missing", f"a file of FRFs holds {', '.join(REQUIRED)}")
    frequency = _numbers(path, arrays, "frequency_hz").ravel()
    if (
        not len(frequency)
        or not np.isfinite(frequency).all()
        or frequency[0] < 0
        or (np.diff(frequency) <= 0).any()
    ):
        raise recording_error(path, "frequency_hz", "does not ascend from 0 or above", "sort the lines")
    accelerance = _numbers(path, arrays, "accelerance", complex).reshape(
        (1, -1) if arrays["accelerance"].ndim < 2 else arrays["accelerance"].shape
    )
    count = len(accelerance)
    if accelerance.shape != (count, len(frequency)) or not count:
        raise recording_error(
            path, "accelerance", f"has the shape {accelerance.shape}", f"it is FRFs × {len(frequency)} lines"
        )
    responses, references = (_dofs(path, arrays, end, count) for end in ("response", "reference"))
    coherence = None
    if "coherence" in arrays:
        coherence = _numbers(path, arrays, "coherence")
        if coherence.size != accelerance.size:
            raise recording_error(path, "coherence", f"has the shape {coherence.shape}", "it is FRFs × lines")
        coherence = coherence.reshape(accelerance.shape)
    return [
        Frf(
            responses[i],
            references[i],
            frequency,
            accelerance[i],
            None if coherence is None else coherence[i],
        )
        for i in range(count)
    ]


def _dofs(path: Path, arrays: Arrays, end: str, count: int) -> list[Dof]:
    nodes = _per_frf(path, arrays, f"{end}_node", count, 1)
    points = _per_frf(path, arrays, f"{end}_mm", count, 3)
    directions = _per_frf(path, arrays, f"{end}_direction", count, 3)
    assert nodes is not None
    if (
        not np.isfinite(nodes).all()
        or (nodes != np.round(nodes)).any()
        or np.abs(nodes).max() > _LARGEST_NODE
    ):
        raise recording_error(path, f"{end}_node", "are not all whole numbers", "number the points")
    if directions is not None and not np.allclose(np.linalg.norm(directions, axis=1), 1.0, atol=_UNIT):
        raise recording_error(
            path, f"{end}_direction", "are not unit vectors", "write Cartesian unit vectors, one per FRF"
        )
    return [
        Dof(
            int(nodes[i, 0]),
            None if points is None else _vector(points[i] * _MM),
            None if directions is None else _vector(directions[i]),
        )
        for i in range(count)
    ]


def _per_frf(path: Path, arrays: Arrays, name: str, count: int, width: int) -> np.ndarray | None:
    """An array of one row per FRF; a single row stands for all."""
    if name not in arrays:
        return None
    values = _numbers(path, arrays, name)
    if values.size not in (width, count * width) or not values.size:
        raise recording_error(
            path, name, f"has the shape {values.shape}", f"it has {width} values for each of {count} FRFs"
        )
    return np.broadcast_to(values.reshape(-1, width), (count, width))


def _numbers(path: Path, arrays: Arrays, name: str, kind: type = float) -> np.ndarray:
    array = arrays[name]
    if array.dtype.kind not in ("iufc" if kind is complex else "iuf"):
        raise recording_error(path, name, f"holds {quoted(str(array.dtype))}, not numbers", "store numbers")
    return array.astype(kind)


def _vector(values: np.ndarray) -> Vector:
    return (float(values[0]), float(values[1]), float(values[2]))
