"""Directions as universal files write them: ±1, ±2, ±3 in a displacement coordinate system of the node."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable
from pathlib import Path

import numpy as np

from statorhom.recordings.dof import Dof, Vector
from statorhom.recordings.message import recording_error
from statorhom.recordings.uff.coordinate_systems import CYLINDRICAL, GLOBAL, CoordinateSystem

CARTESIAN_LABEL, CYLINDRICAL_LABEL = 1, 2
SYSTEMS = {
    CARTESIAN_LABEL: GLOBAL,
    CYLINDRICAL_LABEL: CoordinateSystem(CYLINDRICAL, np.eye(3), np.zeros(3)),
}
_ALIGNED = 1e-6


def direction_code(dof: Dof, label: int) -> int | None:
    """±1, ±2, ±3 of a direction in a system; 0 where the direction is unknown, None where it is oblique."""
    if dof.direction is None:
        return 0
    for axis in range(3):
        vector = SYSTEMS[label].direction(dof.position or (0.0, 0.0, 0.0), axis)
        if vector is not None:
            cosine = float(np.dot(vector, dof.direction))
            if abs(cosine) > 1 - _ALIGNED:
                return axis + 1 if cosine > 0 else -axis - 1
    return None


def displacement_systems(path: Path, dofs: Iterable[Dof]) -> dict[int, int]:
    """The displacement coordinate system of every node: cylindrical for all that allow it where one needs it.

    Parameters
    ----------
    path : Path
        File that is written, for messages.
    dofs : iterable of Dof

    Returns
    -------
    dict of int to int
        Labels by the nodes' numbers.

    Raises
    ------
    RecordingError
        Where directions of a node are axes of neither system.
    """
    by_node = defaultdict(list)
    for dof in dofs:
        by_node[dof.node].append(dof)

    def allow(label: int) -> set[int]:
        return {
            node
            for node, own in by_node.items()
            if all(direction_code(dof, label) is not None for dof in own)
        }

    cartesian = allow(CARTESIAN_LABEL)
    cylindrical = allow(CYLINDRICAL_LABEL) & {n for n, own in by_node.items() if own[0].position is not None}
    if cartesian == set(by_node):
        return dict.fromkeys(by_node, CARTESIAN_LABEL)
    for node in by_node:
        if node not in cartesian | cylindrical:
            raise recording_error(
                path,
                f"node {node}",
                "has directions that are neither x, y, z nor radial, tangential, axial",
                "universal files are written with these only",
            )
    return {node: CYLINDRICAL_LABEL if node in cylindrical else CARTESIAN_LABEL for node in by_node}


def positions(path: Path, known: Iterable[tuple[int, Vector | None]]) -> dict[int, Vector]:
    """Positions of the nodes by number.

    Raises
    ------
    RecordingError
        Where a number stands for two places.
    """
    found: dict[int, Vector] = {}
    for node, position in known:
        if position is not None and not np.allclose(found.setdefault(node, position), position, atol=1e-9):
            raise recording_error(path, f"node {node}", "lies at two places", "give each its own number")
    return found
