"""Figures without pyplot's global state, and their bytes: the same input gives the same bytes."""

from __future__ import annotations

import io
from typing import Literal

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image

INK = "#22303c"
FAINT_INK = "#5d6b77"
FAINT = "#8a96a1"
GRID = "#dfe4e8"
MEASURED = "#22303c"
SIMULATED = "#0072b2"
PREDICTED = "#d55e00"
DATA = "#0a7d5a"
PRIOR = "#d9dfe5"
DIVERGING = "RdBu_r"

FONT_PT = 8.0
_MM = 1 / 25.4
_OVERSAMPLING = 2


def new_figure(width_mm: float, height_mm: float, placed: bool = False) -> Figure:
    """A white figure of a size on paper; `placed`: its axes are placed by hand, which is quicker."""
    size = (width_mm * _MM, height_mm * _MM)
    return Figure(figsize=size, facecolor="white", layout=None if placed else "constrained")


def tidy(axes: Axes, grid: Literal["both", "x", "y"] | None = None) -> None:
    """Thin axes, small figures and grid lines along one axis."""
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    for spine in axes.spines.values():
        spine.set_color(FAINT)
        spine.set_linewidth(0.6)
    axes.tick_params(labelsize=FONT_PT - 0.5, colors=INK, width=0.6, length=2.5)
    axes.xaxis.label.set(size=FONT_PT, color=INK)
    axes.yaxis.label.set(size=FONT_PT, color=INK)
    if grid:
        axes.grid(axis=grid, color=GRID, linewidth=0.5)
        axes.set_axisbelow(True)


def safe(label: str, longest: int = 40) -> str:
    """A name from a file as a figure may show it: no mathematics, only letters the figure's font has."""
    shown = "".join(c if c.isprintable() and ord(c) < 0x0500 else "□" for c in label)
    shown = shown if len(shown) <= longest else shown[: longest - 1] + "…"
    return shown.replace("$", r"\$")


def svg(figure: Figure) -> bytes:
    """SVG with letters as outlines, so that no font is needed to show it."""
    buffer = io.BytesIO()
    with mpl.rc_context({"svg.hashsalt": "statorhom", "svg.fonttype": "path"}):
        figure.savefig(buffer, format="svg", metadata={"Date": None, "Creator": None})
    return buffer.getvalue()


def png(figure: Figure, dpi: int = 200) -> bytes:
    """PNG for pictures of many polygons: drawn at twice the resolution, then averaged.

    Polygons that are not antialiased themselves leave no hairlines between neighbours this way.
    """
    figure.set_dpi(_OVERSAMPLING * dpi)
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    image = Image.fromarray(np.asarray(canvas.buffer_rgba())).convert("RGB").reduce(_OVERSAMPLING)
    buffer = io.BytesIO()
    image.save(buffer, format="PNG")
    return buffer.getvalue()
