"""Cross-section of half a slot pitch as quadrilateral patches between lines and circular arcs.

The half pitch reaches from the centre of tooth 0 (θ = 0) to the centre of the next slot (θ = π/N). Every
slot shape is a set of such patches; what is meshed, integrated exactly or drawn is always this object.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

Point = tuple[float, float]

ORIGIN: Point = (0.0, 0.0)


def polar(radius: float, angle: float) -> Point:
    """Point at `radius` (m) and `angle` (rad)."""
    return (radius * math.cos(angle), radius * math.sin(angle))


@dataclass(frozen=True)
class Edge:
    """Boundary curve of patches.

    Parameters
    ----------
    start, end : names of the section's points.
    division : name of the number of cells along it (a key of `MeshDensity`).
    center : centre of the circular arc (m); None for a straight line. Arcs are shorter than π.
    dense_at : the end ("start" or "end") towards which cells shrink, or None.
    """

    start: str
    end: str
    division: str
    center: Point | None = None
    dense_at: str | None = None


@dataclass(frozen=True)
class Patch:
    """Four-sided piece of the section.

    Parameters
    ----------
    name : what it is, for messages and pictures.
    corners : four point names, counter-clockwise.
    core : region over the core's length ("lamination", "winding") or None where there is air.
    overhang : whether the winding's end ring covers it.
    """

    name: str
    corners: tuple[str, str, str, str]
    core: str | None = None
    overhang: bool = False


@dataclass(frozen=True)
class Section:
    """Points, edges and patches of half a slot pitch.

    Parameters
    ----------
    points : name → (x, y) in metres.
    edges : all edges; each pair of neighbouring corners of a patch is one of them.
    patches : the patches of core and overhang.
    outer : names of the points on the back of the core, from θ = 0 to π/N.
    """

    points: Mapping[str, Point]
    edges: tuple[Edge, ...]
    patches: tuple[Patch, ...]
    outer: tuple[str, ...]
    _by_ends: Mapping[frozenset[str], Edge] = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "points", MappingProxyType(dict(self.points)))
        by_ends = {frozenset((e.start, e.end)): e for e in self.edges}
        object.__setattr__(self, "_by_ends", MappingProxyType(by_ends))

    def edge(self, a: str, b: str) -> Edge:
        """The edge between two neighbouring corners, whichever way it was defined."""
        return self._by_ends[frozenset((a, b))]

    def angle(self, point: str) -> float:
        """θ of a point (rad)."""
        x, y = self.points[point]
        return math.atan2(y, x)

    def width_on_back(self, division: str) -> float:
        """Widest angle (rad) of the back of the core that an edge of this division takes; 0 if none does."""
        columns = itertools.pairwise(self.outer)
        widths = [self.angle(b) - self.angle(a) for a, b in columns if self.edge(a, b).division == division]
        return max(widths, default=0.0)

    def area(self, patch: Patch) -> float:
        """Exact area of a patch (m²), by Green's theorem along its lines and arcs."""
        c = patch.corners
        return sum(self._sweep(c[i], c[(i + 1) % 4]) for i in range(4))

    def _sweep(self, a: str, b: str) -> float:
        (xa, ya), (xb, yb) = self.points[a], self.points[b]
        center = self.edge(a, b).center
        if center is None:
            return 0.5 * (xa * yb - xb * ya)
        cx, cy = center
        radius = math.hypot(xa - cx, ya - cy)
        ta, tb = math.atan2(ya - cy, xa - cx), math.atan2(yb - cy, xb - cx)
        turn = math.remainder(tb - ta, 2 * math.pi)
        moment = cx * (math.sin(ta + turn) - math.sin(ta)) - cy * (math.cos(ta + turn) - math.cos(ta))
        return 0.5 * (radius**2 * turn + radius * moment)
