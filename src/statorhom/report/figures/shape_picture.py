"""A mode shape: the deformed stator, and the outlines of its two ends seen along the axis."""

from __future__ import annotations

from dataclasses import dataclass

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes

from statorhom.report.figures.canvas import DIVERGING, FAINT, INK, SIMULATED, new_figure, png
from statorhom.report.figures.surface_drawing import View, draw_smooth, fit_view
from statorhom.results.full_surface import FullSurface

WIDTH_MM = 82.0
_HEIGHT_MM = 50.0
_SOLID, _ENDS = (0.0, 0.0, 0.62, 1.0), (0.64, 0.1, 0.36, 0.8)  # left, bottom, width, height
_AMPLITUDE = 0.13  # largest drawn displacement over the outer radius
_LEAST_RADIAL = 0.3  # of the largest displacement: full colour
_ON_SURFACE = 1e-6


@dataclass(frozen=True)
class DrawnStator:
    """What all pictures of a stage share: its surface, and which nodes lie on its outer cylinder."""

    surface: FullSurface
    radius: float
    angle: np.ndarray
    outer: np.ndarray

    @classmethod
    def of(cls, surface: FullSurface) -> DrawnStator:
        """Measure a surface."""
        r = np.hypot(*surface.nodes[:, :2].T)
        angle = np.arctan2(surface.nodes[:, 1], surface.nodes[:, 0])
        size = float(r.max())
        outer = np.flatnonzero(r > size * (1 - _ON_SURFACE))
        return cls(surface, size, angle, outer)

    def picture(self, displacement: np.ndarray) -> bytes:
        """See `shape_picture`."""
        return shape_picture(self, displacement)


def shape_picture(stator: DrawnStator, displacement: np.ndarray) -> bytes:
    """PNG of one mode; `displacement` (f, 3) in cylindrical components, any scale."""
    figure = new_figure(WIDTH_MM, _HEIGHT_MM, placed=True)
    solid, ends = figure.add_axes(_SOLID), figure.add_axes(_ENDS)
    scale = _AMPLITUDE * stator.radius / max(float(np.linalg.norm(displacement, axis=1).max()), 1e-30)
    drawn = displacement * scale
    _draw_solid(solid, stator, drawn)
    _draw_ends(ends, stator, drawn)
    return png(figure, dpi=200)


def cartesian(angle: np.ndarray, displacement: np.ndarray) -> np.ndarray:
    """Cylindrical components at angles (rad) as Cartesian ones."""
    radial, tangential, axial = displacement.T
    c, s = np.cos(angle), np.sin(angle)
    return np.column_stack([radial * c - tangential * s, radial * s + tangential * c, axial])


def _draw_solid(axes: Axes, stator: DrawnStator, drawn: np.ndarray) -> None:
    view = View()
    moved = stator.surface.nodes + cartesian(stator.angle, drawn)
    radial = drawn[:, 0]
    # a torsion has next to no radial motion: its remainder must not look like much
    largest = max(
        float(np.abs(radial).max()), _LEAST_RADIAL * float(np.linalg.norm(drawn, axis=1).max()), 1e-30
    )
    rgb = mpl.colormaps[DIVERGING](0.5 + 0.43 * radial / largest)[:, :3]
    draw_smooth(axes, view, moved, stator.surface.quads, rgb)
    low, high = stator.surface.nodes[stator.outer, 2].min(), stator.surface.nodes[stator.outer, 2].max()
    turn = np.linspace(0.0, 2 * np.pi, 181)
    front = np.cos(turn) * view.towards[0] + np.sin(turn) * view.towards[1] > 0
    for z, shown in ((high, np.ones_like(front)), (low, front)):
        circle = np.column_stack([np.cos(turn), np.sin(turn), np.full_like(turn, z / stator.radius)])
        flat = view.project(circle * stator.radius)
        flat[~shown] = np.nan
        axes.plot(*flat.T, color=INK, linewidth=0.6, linestyle=(0, (4, 2)), alpha=0.8)
    fit_view(axes, view.project(moved))


def _draw_ends(axes: Axes, stator: DrawnStator, drawn: np.ndarray) -> None:
    z = stator.surface.nodes[stator.outer, 2]
    turn = np.linspace(0.0, 2 * np.pi, 181)
    axes.plot(np.cos(turn), np.sin(turn), color=FAINT, linewidth=0.7, linestyle=(0, (4, 2)))
    amplified = 1.6 * drawn / stator.radius
    for level, colour, dash, width in (
        (z.min(), SIMULATED, (0, (2.5, 1.2)), 1.0),
        (z.max(), INK, "solid", 1.3),
    ):
        ring = stator.outer[np.abs(z - level) < _ON_SURFACE * stator.radius]
        ring = ring[np.argsort(stator.angle[ring])]
        ring = np.append(ring, ring[0])
        a = stator.angle[ring]
        line = np.column_stack([np.cos(a), np.sin(a)]) + cartesian(a, amplified[ring])[:, :2]
        axes.plot(*line.T, color=colour, linewidth=width, linestyle=dash)
    axes.set_xlim(-1.28, 1.28)
    axes.set_ylim(-1.28, 1.28)
    axes.set_aspect("equal")
    axes.axis("off")
