"""The mesh: one slot pitch, and the whole stator copied from it."""

from __future__ import annotations

import numpy as np
from matplotlib.colors import to_rgb
from matplotlib.patches import Patch

from statorhom.mesh.hex_mesh import HalfPitchMesh
from statorhom.report.figures.canvas import FONT_PT, INK, new_figure, png, safe
from statorhom.report.figures.surface_drawing import View, draw_cells, fit_view
from statorhom.results.full_surface import FullSurface, pitch_surface

WIDTH_MM = 170.0
_HEIGHT_MM = 84.0
_REGION_COLOURS = {
    "lamination": "#8fb3cf",
    "winding": "#c9803f",
    "overhang": "#e3a869",
    "frame": "#a9b8a4",
    "machine": "#b3a4c2",
}
_OTHER = "#c9ccd1"


def mesh_picture(mesh: HalfPitchMesh, whole: FullSurface) -> bytes:
    """PNG with one slot pitch on the left and the whole stator on the right, coloured by region."""
    figure = new_figure(WIDTH_MM, _HEIGHT_MM, placed=True)
    left, right = figure.add_axes((0.0, 0.08, 0.4, 0.92)), figure.add_axes((0.4, 0.08, 0.6, 0.92))
    colours = np.array([to_rgb(_REGION_COLOURS.get(name, _OTHER)) for name in mesh.regions])
    for axes, surface, view in (
        (left, pitch_surface(mesh), View(-38.0, 30.0)),
        (right, whole, View(-60.0, 36.0)),
    ):
        draw_cells(axes, view, surface.nodes, surface.quads, colours[surface.region])
        fit_view(axes, view.project(surface.nodes))
    handles = [Patch(color=colours[i], label=safe(name)) for i, name in enumerate(mesh.regions)]
    figure.legend(
        handles=handles, loc="lower center", ncols=len(handles), frameon=False, fontsize=FONT_PT,
        labelcolor=INK,
    )  # fmt: skip
    return png(figure, dpi=200)
