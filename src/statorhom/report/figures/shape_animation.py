"""A measured mode shape in motion: all planes' rings over one period, as a GIF."""

from __future__ import annotations

import io
from collections.abc import Iterator
from typing import Any, cast

import matplotlib as mpl
import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from PIL import Image

from statorhom.modes.measured_shape import MeasuredShape
from statorhom.report.figures.canvas import DIVERGING, FAINT, FAINT_INK, FONT_PT, GRID, INK, new_figure, safe
from statorhom.report.figures.ring_motion import RingMotion, at_phase
from statorhom.report.figures.surface_drawing import View

_WIDTH_MM, _HEIGHT_MM, _DPI = 130.0, 78.0, 110
_BODY, _END, _SCALE = (0.0, 0.02, 0.58, 0.86), (0.58, 0.12, 0.41, 0.72), (0.665, 0.085, 0.24, 0.022)
_FRAMES, _FRAME_MS = 24, 60
_COLOURS = 128
_LIMIT = 1.32
_SHORTEST = 1.1  # drawn length over the radius: rings that lie closer would hide each other


def animate_shape(shape: MeasuredShape, title: str, subtitle: str = "") -> bytes:
    """GIF of one period: the body seen obliquely on the left, its planes seen along the axis on the right.

    Parameters
    ----------
    shape : MeasuredShape
        Complex motion: what is out of phase is seen to travel.
    title, subtitle : str
        Name and frequency of the mode, and what else is to be said; shown as plain text.

    Raises
    ------
    IdentificationError
        When the points do not show circumferential orders.
    """
    motion = RingMotion.of(shape)
    drawing = _Drawing(motion, title, subtitle)
    frames = [Image.fromarray(picture) for picture in drawing.pictures()]
    # one palette for all frames, else colours flicker
    palette = frames[0].quantize(_COLOURS)
    first, *others = (frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in frames)
    buffer = io.BytesIO()
    first.save(
        buffer, format="GIF", save_all=True, append_images=others, duration=_FRAME_MS, loop=0, disposal=1
    )
    return buffer.getvalue()


class _Drawing:
    """Figure whose rings move while everything else stays."""

    def __init__(self, motion: RingMotion, title: str, subtitle: str) -> None:
        self.motion, self.view = motion, View(elevation=24.0)
        figure = new_figure(_WIDTH_MM, _HEIGHT_MM, placed=True)
        figure.set_dpi(_DPI)
        self.canvas = FigureCanvasAgg(figure)
        figure.text(0.02, 0.93, safe(title), size=FONT_PT + 3, color=INK, weight="bold")
        figure.text(0.98, 0.935, safe(subtitle, 70), size=FONT_PT - 0.5, color=FAINT_INK, ha="right")
        self.stretch, self.middle = _stretch(motion)
        self.largest = float(np.nanmax(np.abs(motion.points[0])))
        self.body, self.end = figure.add_axes(_BODY), figure.add_axes(_END)
        _scale(figure)
        self._still()
        self.moving = [*self._body_lines(), *self._end_lines()]
        self.canvas.draw()
        self.background = self.canvas.copy_from_bbox(figure.bbox)

    def pictures(self) -> Iterator[np.ndarray]:
        """RGB of every frame of one period."""
        for step in range(_FRAMES):
            phase = self.motion.phase + 2 * np.pi * step / _FRAMES
            self.canvas.restore_region(self.background)
            self._move(phase)
            for line in self.moving:
                assert line.axes is not None
                line.axes.draw_artist(line)
            yield np.asarray(self.canvas.buffer_rgba())[..., :3].copy()

    def _projected(self, positions: np.ndarray) -> np.ndarray:
        stretched = positions * [1, 1, self.stretch] - [0, 0, self.middle]
        return self.view.project(stretched)

    def _still(self) -> None:
        turn = np.linspace(0, 2 * np.pi, 145)
        circle = np.column_stack([np.cos(turn), np.sin(turn)])
        for z in self.motion.z_m[np.isfinite(self.motion.curves).any(axis=1)]:
            rest = np.column_stack([circle, np.full(turn.size, z / self.motion.radius_m)])
            self.body.plot(*self._projected(rest).T, color=GRID, linewidth=0.8, zorder=0)
        self.end.plot(*circle.T, color=FAINT, linewidth=0.8, linestyle=(0, (4, 2)), zorder=0)
        for degrees in (0, 90, 180, 270):
            x, y = 1.24 * np.cos(np.radians(degrees)), 1.24 * np.sin(np.radians(degrees))
            self.end.text(x, y, f"{degrees}°", size=FONT_PT - 1.5, color=FAINT_INK, ha="center", va="center")
        for axes, limits in (
            (self.body, self._body_limits()),
            (self.end, (-_LIMIT, _LIMIT, -_LIMIT, _LIMIT)),
        ):
            axes.axis(limits)
            axes.set_aspect("equal")
            axes.axis("off")

    def _body_limits(self) -> tuple[float, float, float, float]:
        rest = self._projected(self.motion.rings(self.motion.phase + np.pi / 2))
        finite = rest[np.isfinite(rest).all(axis=-1)]
        (x0, y0), (x1, y1) = finite.min(axis=0), finite.max(axis=0)
        return x0 - 0.28, x1 + 0.28, y0 - 0.22, y1 + 0.22

    def _body_lines(self) -> list[Artist]:
        self.meridians = LineCollection([], colors=FAINT, linewidths=0.5, zorder=1)
        self.rings = LineCollection([], linewidths=2.2, zorder=2, capstyle="round")
        self.body.add_collection(self.meridians, autolim=False)
        self.body.add_collection(self.rings, autolim=False)
        # nearly white rings would be lost on white
        self.edges = LineCollection([], colors=FAINT, linewidths=2.9, zorder=1.5)
        self.body.add_collection(self.edges, autolim=False)
        (self.dots,) = self.body.plot([], [], ".", color=INK, markersize=2.2, zorder=3)
        return [self.meridians, self.edges, self.rings, self.dots]

    def _end_lines(self) -> list[Artist]:
        shades = mpl.colormaps["viridis"](np.linspace(0.0, 0.85, self.motion.z_m.size))
        self.outlines = LineCollection([], colors=shades, linewidths=1.2)
        self.end.add_collection(self.outlines, autolim=False)
        _plane_labels(self.end, self.motion, shades)
        return [self.outlines]

    def _move(self, phase: float) -> None:
        rings, places = self.motion.rings(phase), self.motion.places(phase)
        flat, dots = self._projected(rings), self._projected(places)
        self.rings.set_segments(list(np.stack([flat[:, :-1], flat[:, 1:]], axis=2).reshape(-1, 2, 2)))
        colour = at_phase(self.motion.curves[:, :-1], phase).ravel() / self.largest
        self.rings.set_color(
            cast(Any, mpl.colormaps[DIVERGING](0.5 + 0.48 * np.clip(np.nan_to_num(colour), -1, 1)))
        )
        self.edges.set_segments(list(flat))
        self.meridians.set_segments([line[np.isfinite(line).all(axis=1)] for line in dots.transpose(1, 0, 2)])
        self.dots.set_data(*dots.reshape(-1, 2).T)
        self.outlines.set_segments(list(rings[:, :, :2]))


def _stretch(motion: RingMotion) -> tuple[float, float]:
    """Factor by which a short body is drawn longer, and its drawn middle height."""
    height = motion.z_m / motion.radius_m
    length = float(np.ptp(height))
    factor = max(1.0, _SHORTEST / length) if length > 0 else 1.0
    return factor, factor * float(height.min() + height.max()) / 2


def _scale(figure: Figure) -> None:
    axes = figure.add_axes(_SCALE)
    axes.imshow(
        np.linspace(0.02, 0.98, 100)[None],
        cmap=DIVERGING,
        vmin=0,
        vmax=1,
        aspect="auto",
        extent=(-1, 1, 0, 1),
    )
    axes.set_yticks([])
    axes.set_xticks([-1, 0, 1], labels=["inwards", "0", "outwards"])
    axes.tick_params(labelsize=FONT_PT - 1.5, colors=FAINT_INK, length=0, pad=2)
    for spine in axes.spines.values():
        spine.set_visible(False)


def _plane_labels(axes: Axes, motion: RingMotion, shades: np.ndarray) -> None:
    shown = np.unique(np.linspace(0, motion.z_m.size - 1, min(motion.z_m.size, 6)).round().astype(int))
    for row, plane in enumerate(shown[::-1]):
        axes.text(
            0.0, 0.11 * (len(shown) / 2 - row - 0.5) * 1.6, f"z = {1000 * motion.z_m[plane]:.3g} mm",
            size=FONT_PT - 1.5, color=shades[plane], ha="center", va="center",
        )  # fmt: skip
