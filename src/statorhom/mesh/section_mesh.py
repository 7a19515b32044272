"""Structured 8-node quadrilaterals on the section, made by gmsh."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType, ModuleType

import numpy as np

from statorhom.geometry.section import Edge, Patch, Section
from statorhom.mesh.curved_midsides import follow_boundary
from statorhom.mesh.density import MeshDensity
from statorhom.mesh.gmsh_session import gmsh_session

QUAD8 = 16  # gmsh's number of the 8-node quadrilateral: 4 corners, then the mid-sides of edges 01, 12, 23, 30


@dataclass(frozen=True)
class SectionMesh:
    """Quadrilaterals of every patch of a section.

    Parameters
    ----------
    points : (n, 2) node positions (m); mid-side nodes of edges on arcs lie on the arcs.
    quads : patch name → (i, j, 8) node numbers, counter-clockwise; i counts from the patch's first corner to
        its second, j from its first to its last.
    """

    points: np.ndarray
    quads: Mapping[str, np.ndarray]

    def __post_init__(self) -> None:
        self.points.setflags(write=False)
        object.__setattr__(self, "quads", MappingProxyType(dict(self.quads)))


def mesh_section(section: Section, density: MeshDensity) -> SectionMesh:
    """Mesh all patches with transfinite quadrilaterals of second order."""
    cells = {
        division: density.across(division, section.width_on_back(division))
        for division in {edge.division for edge in section.edges}
    }
    with gmsh_session() as gmsh:
        surfaces = _draw(gmsh, section, cells, density)
        gmsh.model.mesh.generate(2)
        points, quads = _extract(gmsh, surfaces)
    grids = {patch.name: _grid(quads[patch.name], section, patch, cells) for patch in section.patches}
    return SectionMesh(follow_boundary(points, grids.values()), grids)


def _draw(
    gmsh: ModuleType, section: Section, cells: Mapping[str, int], density: MeshDensity
) -> dict[str, int]:
    """Draw the section and return the number of every patch's surface."""
    geo = gmsh.model.geo
    points = {name: geo.addPoint(x, y, 0.0) for name, (x, y) in section.points.items()}
    curves = _draw_edges(gmsh, section, points)
    for edge, curve in curves.items():
        count = cells[edge.division]
        ratio = density.progression(count) if edge.dense_at is not None else 1.0
        toward_end = ratio if edge.dense_at == "start" else 1 / ratio
        geo.mesh.setTransfiniteCurve(curve, count + 1, "Progression", toward_end)
    surfaces = {}
    for patch in section.patches:
        sides = zip(patch.corners, patch.corners[1:] + patch.corners[:1], strict=True)
        loop = geo.addCurveLoop([_signed(curves, section, a, b) for a, b in sides])
        surfaces[patch.name] = geo.addPlaneSurface([loop])
        geo.mesh.setTransfiniteSurface(
            surfaces[patch.name], cornerTags=[points[corner] for corner in patch.corners]
        )
        geo.mesh.setRecombine(2, surfaces[patch.name])
    geo.synchronize()
    return surfaces


def _draw_edges(gmsh: ModuleType, section: Section, points: Mapping[str, int]) -> dict[Edge, int]:
    geo = gmsh.model.geo
    centers = {c: geo.addPoint(*c, 0.0) for c in {e.center for e in section.edges} if c is not None}
    curves = {}
    for edge in section.edges:
        start, end = points[edge.start], points[edge.end]
        if edge.center is None:
            curves[edge] = geo.addLine(start, end)
        else:
            curves[edge] = geo.addCircleArc(start, centers[edge.center], end)
    return curves


def _signed(curves: Mapping[Edge, int], section: Section, a: str, b: str) -> int:
    edge = section.edge(a, b)
    return curves[edge] if edge.start == a else -curves[edge]


def _extract(gmsh: ModuleType, surfaces: Mapping[str, int]) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """Positions (n, 2) of the nodes of elements, and the (m, 8) quadrilaterals of every patch."""
    tags, coordinates, _ = gmsh.model.mesh.getNodes()
    raw = {}
    for name, surface in surfaces.items():
        types, _, nodes = gmsh.model.mesh.getElements(2, surface)
        assert list(types) == [QUAD8], f"patch {name} was not meshed with 8-node quadrilaterals"
        raw[name] = np.asarray(nodes[0], dtype=np.int64).reshape(-1, 8)
    # arc centres are nodes of the model, but of no element
    used = np.unique(np.concatenate([quads.ravel() for quads in raw.values()]))
    order = np.argsort(tags)
    rows = order[np.searchsorted(tags, used, sorter=order)]
    points = np.asarray(coordinates).reshape(-1, 3)[rows, :2]
    return points, {name: np.searchsorted(used, quads) for name, quads in raw.items()}


def _grid(quads: np.ndarray, section: Section, patch: Patch, cells: Mapping[str, int]) -> np.ndarray:
    """The quadrilaterals of a patch as the grid in which gmsh's transfinite algorithm lists them."""
    a, b, c, _ = patch.corners
    grid = quads.reshape(cells[section.edge(a, b).division], cells[section.edge(b, c).division], 8)
    assert np.array_equal(grid[:-1, :, [1, 2]], grid[1:, :, [0, 3]])
    assert np.array_equal(grid[:, :-1, [3, 2]], grid[:, 1:, [0, 1]])
    return grid
