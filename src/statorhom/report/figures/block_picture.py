"""A mode shape or the mesh of a plate or beam, drawn in space."""

from __future__ import annotations

from dataclasses import dataclass

import matplotlib as mpl
import numpy as np
from matplotlib.colors import to_rgb

from statorhom.report.figures.canvas import DIVERGING, INK, new_figure, png
from statorhom.report.figures.surface_drawing import View, draw_cells, draw_smooth, fit_view
from statorhom.results.full_surface import FullSurface

WIDTH_MM = 82.0
_HEIGHT_MM = 50.0
_MESH_WIDTH_MM, _MESH_HEIGHT_MM = 170.0, 84.0
_AMPLITUDE = 0.08  # largest drawn displacement over the longest side
_COLOUR = "#8fb3cf"
_VIEW = View(-58.0, 34.0)


@dataclass(frozen=True)
class DrawnBlock:
    """What all pictures of a block share: its surface and its longest side (m)."""

    surface: FullSurface
    longest: float

    @classmethod
    def of(cls, surface: FullSurface) -> DrawnBlock:
        """Measure a surface."""
        return cls(surface, float(np.ptp(surface.nodes, axis=0).max()))

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
        corners = self._box()
        for a, b in _EDGES:
            axes.plot(*_VIEW.project(corners[[a, b]]).T, color=INK, linewidth=0.5, dashes=(4, 2), alpha=0.7)
        fit_view(axes, _VIEW.project(np.vstack([moved, corners])))
        return png(figure, dpi=200)

    def mesh_picture(self) -> bytes:
        """PNG of the whole mesh."""
        figure = new_figure(_MESH_WIDTH_MM, _MESH_HEIGHT_MM, placed=True)
        axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
        colours = np.tile(to_rgb(_COLOUR), (len(self.surface.quads), 1))
        draw_cells(axes, _VIEW, self.surface.nodes, self.surface.quads, colours)
        fit_view(axes, _VIEW.project(self.surface.nodes))
        return png(figure, dpi=200)

    def _box(self) -> np.ndarray:
        """(8, 3) corners of the box around the undeformed block."""
        ends = np.array([self.surface.nodes.min(axis=0), self.surface.nodes.max(axis=0)])
        return np.array(
            [[ends[i][0], ends[j][1], ends[k][2]] for i in (0, 1) for j in (0, 1) for k in (0, 1)]
        )


# corners that differ in one coordinate
_EDGES = [(a, b) for a in range(8) for b in range(a + 1, 8) if bin(a ^ b).count("1") == 1]
