"""A mode shape or the mesh of a plate, a beam or a wing, drawn in space."""

from __future__ import annotations

from dataclasses import dataclass

import matplotlib as mpl
import numpy as np
import scipy.sparse as sp
from matplotlib.collections import LineCollection
from matplotlib.colors import to_rgb
from scipy.sparse.csgraph import connected_components

from statorhom.report.figures.canvas import DIVERGING, INK, new_figure, png
from statorhom.report.figures.surface_drawing import View, draw_cells, draw_smooth, fit_view
from statorhom.results.full_surface import FullSurface

WIDTH_MM = 82.0
_HEIGHT_MM = 50.0
_MESH_WIDTH_MM, _MESH_HEIGHT_MM = 170.0, 84.0
_AMPLITUDE = 0.08  # largest drawn displacement over the longest side
_COLOUR = "#8fb3cf"
_VIEW = View(-58.0, 34.0)
_SHARP = 0.7  # cosine between the normals of faces: below, their edge is one of the body


@dataclass(frozen=True)
class DrawnBlock:
    """What all pictures of a block share: its surface, its longest side (m) and its sharp edges (e, 2 nodes)."""

    surface: FullSurface
    longest: float
    edges: np.ndarray

    @classmethod
    def of(cls, surface: FullSurface) -> DrawnBlock:
        """Measure a surface."""
        return cls(surface, float(np.ptp(surface.nodes, axis=0).max()), _sharp_edges(surface))

    def picture(self, displacement: np.ndarray) -> bytes:
        """PNG of one mode; `displacement` (f, 3) along x, y and z, any scale.

        Colours are the motion along the axis that moves most.
        """
        figure = new_figure(WIDTH_MM, _HEIGHT_MM, placed=True)
        axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
        drawn = displacement * (_AMPLITUDE * self.longest / max(float(np.abs(displacement).max()), 1e-30))
        along = drawn[:, int(np.argmax(np.sum(drawn**2, axis=0)))]
        rgb = mpl.colormaps[DIVERGING](0.5 + 0.43 * along / max(float(np.abs(along).max()), 1e-30))[:, :3]
        moved = self.surface.nodes + drawn
        draw_smooth(axes, _VIEW, moved, self.surface.quads, rgb)
        ends = _VIEW.project(self.surface.nodes)[self.edges]
        axes.add_collection(LineCollection(list(ends), colors=INK, linewidths=0.5, alpha=0.45, zorder=3))
        fit_view(axes, _VIEW.project(np.vstack([moved, self.surface.nodes])))
        return png(figure, dpi=200)

    def mesh_picture(self) -> bytes:
        """PNG of the whole mesh."""
        figure = new_figure(_MESH_WIDTH_MM, _MESH_HEIGHT_MM, placed=True)
        axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
        colours = np.tile(to_rgb(_COLOUR), (len(self.surface.quads), 1))
        draw_cells(axes, _VIEW, self.surface.nodes, self.surface.quads, colours)
        fit_view(axes, _VIEW.project(self.surface.nodes))
        return png(figure, dpi=200)


def _sharp_edges(surface: FullSurface) -> np.ndarray:
    """Element edges between outer faces that meet at an angle, as pairs of nodes."""
    quads = surface.quads[_outside(surface), :4]
    corners = surface.nodes[quads]
    normals = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    sides = np.sort(np.stack([quads, np.roll(quads, -1, axis=1)], axis=2), axis=2)
    edges, number = np.unique(sides.reshape(-1, 2), axis=0, return_inverse=True)
    order = np.argsort(number.ravel(), kind="stable")
    face, sorted_edge = order // 4, number.ravel()[order]
    twins = np.flatnonzero(sorted_edge[1:] == sorted_edge[:-1])
    cosine = np.sum(normals[face[twins]] * normals[face[twins + 1]], axis=1)
    return np.asarray(edges[sorted_edge[twins[cosine < _SHARP]]])


def _outside(surface: FullSurface) -> np.ndarray:
    """(q,) whether a face is of the outer skin, not of a hollow within."""
    count = len(surface.nodes)
    rows, columns = np.repeat(surface.quads[:, 0], 8), surface.quads.ravel()
    links = sp.coo_array((np.ones(len(rows)), (rows, columns)), shape=(count, count))
    _, part = connected_components(links, directed=False)
    return np.asarray(part[surface.quads[:, 0]] == part[int(np.argmax(surface.nodes[:, 0]))])
