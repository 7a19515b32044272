"""Datasets 15 and 2411, nodes, and 82, trace lines."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from statorhom.recordings.dof import Dof, Vector
from statorhom.recordings.uff.coordinate_systems import GLOBAL, CoordinateSystem
from statorhom.recordings.uff.records import Place, fields, reals
from statorhom.recordings.uff.units import Units

_NODE_15 = ((10, int), (10, int), (10, int), (10, int), (13, float), (13, float), (13, float))
_NODE_2411 = ((10, int), (10, int), (10, int), (10, int))
_TRACE = ((10, int), (10, int), (10, int))
# systems that files use without defining them: the global one
_UNDEFINED_GLOBAL = (0, 1)


@dataclass(frozen=True)
class UffNode:
    """A node: where it is defined, its position (m) and the label of its displacement coordinate system."""

    place: Place
    position: Vector
    system: int


@dataclass(frozen=True)
class Geometry:
    """Nodes and coordinate systems of a file, by number and label."""

    nodes: dict[int, UffNode]
    systems: dict[int, CoordinateSystem]

    def dof(self, node: int, direction: int) -> Dof:
        """The degree of freedom that a node and a direction ±1, ±2, ±3 name; other directions are unknown.

        Raises
        ------
        RecordingError
            Where the node's displacement coordinate system is not defined.
        """
        known = self.nodes.get(node)
        axis = abs(direction) - 1
        vector = None
        if known is None:
            # without nodes there are no displacement systems, so directions are Cartesian
            vector = GLOBAL.direction((0.0, 0.0, 0.0), axis) if not self.nodes and 0 <= axis < 3 else None
        elif 0 <= axis < 3:
            vector = self._system(node, known).direction(known.position, axis)
        if vector is not None and direction < 0:
            vector = (-vector[0], -vector[1], -vector[2])
        return Dof(node, known.position if known else None, vector)

    def _system(self, number: int, node: UffNode) -> CoordinateSystem:
        system = self.systems.get(node.system)
        if system is not None:
            return system
        if node.system in _UNDEFINED_GLOBAL or not self.systems:
            return GLOBAL
        raise node.place.error(
            None,
            f"directions of node {number} are those of coordinate system {node.system}, which is not defined",
            "export dataset 2420 with it",
        )


def read_nodes(place: Place, lines: list[str], units: Units) -> list[tuple[int, UffNode]]:
    """Read dataset 15 or 2411.

    Coordinates are global and Cartesian.

    Raises
    ------
    RecordingError
    """
    step = 1 if place.kind == 15 else 2
    nodes = []
    for start in range(0, len(lines), step):
        line = start + 2
        if start + step > len(lines):
            raise place.error(line, "ends within a node", "the file is truncated; export it again")
        if step == 1:
            number, _, system, _, *coordinates = fields(place, line, lines[start], _NODE_15)
        else:
            number, _, system, _ = fields(place, line, lines[start], _NODE_2411)
            coordinates = reals(place, line + 1, lines[start + 1], 3)
        if not np.isfinite(coordinates).all():
            raise place.error(line, f"coordinates of node {number} are not finite")
        x, y, z = (coordinate / units.length for coordinate in coordinates)
        nodes.append((number, UffNode(place, (x, y, z), system)))
    return nodes


def merge_nodes(nodes: list[tuple[int, UffNode]]) -> tuple[dict[int, UffNode], list[str]]:
    """Nodes by number; repetitions are dropped with a remark.

    Raises
    ------
    RecordingError
        Where a number stands for two places or two displacement coordinate systems.
    """
    merged: dict[int, UffNode] = {}
    repeated: set[int] = set()
    for number, node in nodes:
        first = merged.setdefault(number, node)
        if first is node:
            continue
        repeated.add(number)
        if not np.allclose(first.position, node.position, rtol=0.0, atol=1e-6) or first.system != node.system:
            raise node.place.error(
                None,
                f"node {number} is defined twice, with different coordinates or directions",
                "delete or renumber one of the two",
            )
    remarks = [f"{len(repeated)} nodes are defined more than once, in the same way"] if repeated else []
    return merged, remarks


def read_trace_line(place: Place, lines: list[str]) -> list[tuple[int, ...]]:
    """Read dataset 82 as polylines through nodes; a 0 in the file lifts the pen.

    Raises
    ------
    RecordingError
    """
    if len(lines) < 2:
        raise place.error(None, "ends within its header", "the file is truncated; export it again")
    _, count, _ = fields(place, 2, lines[0], _TRACE)
    words = [word for line in lines[2:] for word in line.split()]
    if count > len(words):
        raise place.error(2, f"promises {count} nodes, but holds {len(words)}")
    polylines: list[list[int]] = [[]]
    for number in reals(place, 4, " ".join(words[:count]), max(count, 0)):
        if number:
            polylines[-1].append(int(number))
        else:
            polylines.append([])
    return [tuple(polyline) for polyline in polylines if len(polyline) > 1]
