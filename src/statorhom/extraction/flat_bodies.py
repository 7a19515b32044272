"""Names of measured modes of plates and wings: points in a plane that move across it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from statorhom.errors import IdentificationError
from statorhom.extraction.extraction import ExtractedMode
from statorhom.modes.plan_form import PlanFormName, name_plan_form, ordinal_labels
from statorhom.recordings.dof import Dof

FloatArray = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]

_FEWEST_POINTS = 6
_FLAT = 0.15  # of its length: how far a wing's points may leave the plane
_LINE = 0.02  # of its length: width of what is no plane yet
_ACROSS = 0.7  # mean cosine between sensors and the plane's normal


def is_flat_body(points: Sequence[Dof]) -> bool:
    """Whether sensors across a plane were placed in it: then shapes have no order around an axis."""
    placed = [(p.position, p.direction) for p in points if p.position is not None and p.direction is not None]
    if len({position for position, _ in placed}) < _FEWEST_POINTS:
        return False
    positions = np.array([position for position, _ in placed])
    _, sizes, axes = np.linalg.svd(positions - positions.mean(axis=0), full_matrices=False)
    flat = sizes[2] < _FLAT * sizes[0] and sizes[1] > _LINE * sizes[0]
    cosines = np.abs(np.array([direction for _, direction in placed]) @ axes[2])
    return bool(flat and cosines.mean() > _ACROSS)


def flat_body_names(modes: Sequence[ExtractedMode], points: Sequence[Dof]) -> tuple[PlanFormName | None, ...]:
    """A name for every mode; None where it has none."""
    names: list[PlanFormName | None] = []
    for mode in modes:
        try:
            names.append(name_plan_form(*displacements(mode.shape, points)))
        except IdentificationError:
            names.append(None)
    return tuple(names)


def flat_body_remarks(names: Sequence[PlanFormName | None]) -> list[str]:
    """What the modes are called, for a table whose columns name orders alone."""
    labels = ordinal_labels(names)
    return [
        f"mode {number}: {label}, {name.statement}"
        for number, (name, label) in enumerate(zip(names, labels, strict=True), start=1)
        if name is not None and label
    ]


def displacements(shape: ComplexArray, points: Sequence[Dof]) -> tuple[FloatArray, ComplexArray]:
    """Positions (nodes, 3) and Cartesian motion (nodes, 3): a node's sensors add up to its displacement."""
    rows: dict[int, int] = {}
    positions: list[tuple[float, float, float]] = []
    for point in points:
        if point.position is not None and point.direction is not None and point.node not in rows:
            rows[point.node] = len(positions)
            positions.append(point.position)
    motion = np.zeros((len(positions), 3), dtype=complex)
    for point, value in zip(points, shape, strict=True):
        if point.direction is not None and point.node in rows:
            motion[rows[point.node]] += value * np.asarray(point.direction)
    return np.array(positions).reshape(-1, 3), motion
