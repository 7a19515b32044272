"""Quadratic surface quads drawn from back to front (painter's algorithm), without those that look away."""

from __future__ import annotations

import math
from typing import Any, cast

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection

_OUTLINE = np.array([0, 4, 1, 5, 2, 6, 3, 7])
# faces are cut into pieces of about this part of the picture's size, none into more than so many along a side
_PIECE, _MOST_CUTS = 1 / 25, 8
# a bent face that looks away as a whole may have pieces that do not
_EDGE_ON = -0.2
_LIGHT = np.array([0.35, 0.45, 0.82])


class View:
    """Orthographic view from an azimuth and an elevation (degrees)."""

    def __init__(self, azimuth: float = -60.0, elevation: float = 36.0) -> None:
        a, e = math.radians(azimuth), math.radians(elevation)
        self.towards = np.array([math.cos(e) * math.cos(a), math.cos(e) * math.sin(a), math.sin(e)])
        right = np.array([-math.sin(a), math.cos(a), 0.0])
        self.plane = np.column_stack([right, np.cross(self.towards, right)])
        light = _LIGHT[0] * right + _LIGHT[1] * self.plane[:, 1] + _LIGHT[2] * self.towards
        self.light = light / np.linalg.norm(light)

    def project(self, points: np.ndarray) -> np.ndarray:
        """Positions (…, 3) on the picture (…, 2)."""
        return np.asarray(points @ self.plane)


def draw_smooth(axes: Axes, view: View, positions: np.ndarray, quads: np.ndarray, rgb: np.ndarray) -> None:
    """Shaded surface.

    Parameters
    ----------
    axes : Axes
    view : View
    positions : (f, 3) Cartesian positions.
    quads : (q, 8) node numbers as in `FullSurface`.
    rgb : (f, 3) colour of every node.
    """
    facing = quads[_facing(view, positions[quads[:, :4]]) > _EDGE_ON]
    if not len(facing):
        return
    corners, colour = _pieces(positions[facing], rgb[facing])
    order, brightness = _visible(view, corners)
    shaded = np.clip(colour[order] * brightness[:, None], 0.0, 1.0)
    _paint(axes, view.project(corners[order]), shaded, "none", 0.0)


def draw_cells(axes: Axes, view: View, positions: np.ndarray, quads: np.ndarray, rgb: np.ndarray) -> None:
    """Faces with the edges of the elements; `rgb` (q, 3) is the colour of every face."""
    faces = positions[quads]
    order, brightness = _visible(view, faces[:, :4])
    shaded = np.clip(rgb[order] * brightness[:, None], 0.0, 1.0)
    outline = view.project(faces[order][:, _OUTLINE])
    _paint(axes, outline, shaded, np.array([[0.13, 0.19, 0.24, 0.75]]), 0.25)


def fit_view(axes: Axes, points: np.ndarray, margin: float = 0.03) -> None:
    """Show all projected points (…, 2) at equal scales, without axes."""
    flat = points.reshape(-1, 2)
    low, high = flat.min(axis=0), flat.max(axis=0)
    pad = margin * float((high - low).max())
    axes.set_xlim(low[0] - pad, high[0] + pad)
    axes.set_ylim(low[1] - pad, high[1] + pad)
    axes.set_aspect("equal")
    axes.axis("off")


def _pieces(faces: np.ndarray, rgb: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Faces (q, 8, 3) with nodal colours (q, 8, 3) → corners (p, 4, 3) and colours (p, 3) of their pieces."""
    size = _PIECE * float(np.ptp(faces.reshape(-1, 3), axis=0).max())
    sides = np.linalg.norm(faces[:, [1, 2]] - faces[:, [0, 1]], axis=2)
    cuts = np.clip(np.ceil(sides / size), 1, _MOST_CUTS).astype(int)
    corners, colours = [], []
    for across, up in np.unique(cuts, axis=0):
        chosen = np.all(cuts == (across, up), axis=1)
        corners.append(_cut(faces[chosen], across, up))
        colours.append(_cut(rgb[chosen], across, up).mean(axis=1))
    return np.concatenate(corners), np.concatenate(colours)


def _cut(values: np.ndarray, across: int, up: int) -> np.ndarray:
    """Nodal values (q, 8, d) → values (q · across · up, 4, d) at the corners of equal pieces."""
    s, t = np.meshgrid(np.linspace(-1, 1, across + 1), np.linspace(-1, 1, up + 1), indexing="ij")
    grid = np.einsum("ijk,qkd->qijd", _serendipity(s, t), values)
    pieces = [grid[:, :-1, :-1], grid[:, 1:, :-1], grid[:, 1:, 1:], grid[:, :-1, 1:]]
    return np.stack(pieces, axis=3).reshape(-1, 4, values.shape[-1])


def _serendipity(s: np.ndarray, t: np.ndarray) -> np.ndarray:
    """Shape functions of the eight-node quadrilateral at (s, t) in [-1, 1]²: (…, 8)."""
    corners = [
        (1 + a * s) * (1 + b * t) * (a * s + b * t - 1) / 4 for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))
    ]
    sides = [
        (1 - s**2) * (1 - t) / 2,
        (1 + s) * (1 - t**2) / 2,
        (1 - s**2) * (1 + t) / 2,
        (1 - s) * (1 - t**2) / 2,
    ]
    return np.stack(corners + sides, axis=-1)


def _normals(corners: np.ndarray) -> np.ndarray:
    normal = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    return np.asarray(normal / np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-30))


def _facing(view: View, corners: np.ndarray) -> np.ndarray:
    """How far faces look at the viewer: 1 straight at them, 0 edge on."""
    return np.asarray(_normals(corners) @ view.towards)


def _visible(view: View, corners: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Faces that look at the viewer, the farthest first, and their brightness."""
    normal = _normals(corners)
    facing = np.flatnonzero(normal @ view.towards > 0.0)
    depth = corners[facing].mean(axis=1) @ view.towards
    order = facing[np.argsort(depth, kind="stable")]
    return order, 0.62 + 0.42 * np.maximum(normal[order] @ view.light, 0.0)


def _paint(axes: Axes, polygons: np.ndarray, face: np.ndarray, edge: np.ndarray | str, width: float) -> None:
    # an array is taken at once, a list polygon by polygon
    axes.add_collection(
        PolyCollection(
            cast(Any, polygons), facecolors=face, edgecolors=edge, linewidths=width, antialiaseds=width > 0
        ),
        autolim=False,
    )
