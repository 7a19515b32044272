"""What a file of measurements holds, whatever its format."""

from __future__ import annotations

from dataclasses import dataclass

from statorhom.recordings.dof import Vector
from statorhom.recordings.frf_set import FrfSet
from statorhom.recordings.hit import Hit
from statorhom.recordings.mode_shape import ModeShape


@dataclass(frozen=True)
class Node:
    """A numbered point and where it lies (m)."""

    number: int
    position: Vector


@dataclass(frozen=True)
class Recording:
    """The measurements of one test.

    Attributes
    ----------
    name : str
        As the file calls itself, else the file's own name without its ending.
    frf_sets : tuple of FrfSet
        One per frequency axis.
    hits : tuple of Hit
        In the order of their numbers.
    shapes : tuple of ModeShape
        Mode shapes that the file carries.
    nodes : tuple of Node
    trace_lines : tuple of tuple of int
        Polylines through nodes, to draw the structure.
    remarks : tuple of str
        What was ignored, tolerated or converted, one line each.
    """

    name: str
    frf_sets: tuple[FrfSet, ...] = ()
    hits: tuple[Hit, ...] = ()
    shapes: tuple[ModeShape, ...] = ()
    nodes: tuple[Node, ...] = ()
    trace_lines: tuple[tuple[int, ...], ...] = ()
    remarks: tuple[str, ...] = ()
