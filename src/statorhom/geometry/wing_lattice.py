"""The right half of a wing as a lattice of cells: columns along the chord, rows along the span, layers upwards.

Every wall is a strip of the lattice, of its own thickness. The strips cross all of the lattice: what of one is no wall
is left empty inside and belongs to the skin in the skins' layers.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from statorhom.geometry.wing import WingGeometry

BAY, EDGE, SPAR, CAGE, RIB = range(5)  # what a strip is
NOTHING = -1
# cells of the bays before, between and behind the spars on the coarsest division; even, as those along the span are, so
# that one and a half times as many are a similar mesh
COLUMNS = (2, 4, 2)
LONGEST = 0.15  # m: cells along the span there
_CUBE = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))
_TETRAHEDRA = ((1, 2), (2, 3), (3, 7), (7, 4), (4, 5), (5, 1))  # all with the corners 0 and 6


@dataclass(frozen=True, eq=False)
class WingLattice:
    """Corners of cells and what the cells are.

    Parameters
    ----------
    corners : (columns + 1, rows + 1, layers + 1, 3) positions (m).
    region : (columns, rows, layers) number of the region, `NOTHING` where there is none.
    axes : (columns, rows, layers, 3, 3) the material's axes as columns, in components along x, y, z.
    """

    corners: np.ndarray
    region: np.ndarray
    axes: np.ndarray

    def volumes(self) -> dict[int, float]:
        """Region → volume of its cells (m³), each cut into six tetrahedra."""
        n = np.array(self.region.shape)
        v = [self.corners[i : n[0] + i, j : n[1] + j, k : n[2] + k] for i, j, k in _CUBE]
        total = sum(
            np.einsum("...i,...i", v[a] - v[0], np.cross(v[b] - v[0], v[6] - v[0])) / 6.0
            for a, b in _TETRAHEDRA
        )
        return {
            int(r): float(np.abs(np.asarray(total)[self.region == r]).sum())
            for r in np.unique(self.region)
            if r != NOTHING
        }


@dataclass(frozen=True, eq=False)
class _Columns:
    """Borders x (columns + 1, rows + 1), what each column is, and its panel."""

    x: np.ndarray
    kind: np.ndarray
    panel: np.ndarray


def wing_lattice(wing: WingGeometry, factor: float = 1.0) -> WingLattice:
    """Divide the right half of a wing.

    Parameters
    ----------
    wing : the wing.
    factor : refinement along chord and span; walls and layers keep their one cell.
    """
    y, rows = _rows(wing, factor)
    columns = _columns(wing, y, factor)
    z = _heights(wing, columns, y)
    x = np.broadcast_to(columns.x[..., None], z.shape)
    corners = np.stack([x, np.broadcast_to(y[None, :, None], z.shape), z], axis=-1)
    inside = 0.5 * (y[1:] + y[:-1]) < (0.0 if wing.cage is None else wing.cage[0] / 2 + wing.cage[1])
    region = _regions(wing, columns.kind, rows, inside)
    return WingLattice(corners, region, _axes(wing, columns, region.shape))


def _rows(wing: WingGeometry, factor: float) -> tuple[np.ndarray, np.ndarray]:
    """Borders (rows + 1,) along the span and what each row is."""
    half = wing.plan.half_span
    walls = [(0.0, wing.web / 2, RIB)]
    if wing.cage is not None:
        walls.append((wing.cage[0] / 2, wing.cage[0] / 2 + wing.cage[1], CAGE))
    walls += [(y - wing.web / 2, y + wing.web / 2, RIB) for y in wing.ribs]
    borders, kinds = [0.0], []
    for begin, end, kind in (*walls, (half - wing.web, half, RIB)):
        if begin > borders[-1]:
            count = _count(2.0 * np.ceil((begin - borders[-1]) / (2.0 * LONGEST)), factor)
            borders += np.linspace(borders[-1], begin, count + 1)[1:].tolist()
            kinds += [BAY] * count
        borders.append(end)
        kinds.append(kind)
    return np.array(borders), np.array(kinds)


def _columns(wing: WingGeometry, y: np.ndarray, factor: float) -> _Columns:
    """The walls of the edges are of the skin's first layers; spars and cage begin at their stations."""
    chord, nose = wing.plan.chord(y), wing.plan.leading_edge(y)
    front, rear = (nose + s * chord for s in wing.plan.stations[1:3])
    edge = wing.edge
    cage = 0.0 if wing.cage is None else wing.cage[1]
    bays = (
        (nose + edge, front),
        (front + wing.web + cage, rear - cage),
        (rear + wing.web, nose + chord - edge),
    )
    borders, kinds, panels = [nose], [EDGE], [0]
    for panel, (begin, end) in enumerate(bays):
        count = _count(COLUMNS[panel], factor)
        borders += [begin + (end - begin) * share for share in np.linspace(0.0, 1.0, count + 1)]
        kinds += [BAY] * count
        panels += [panel] * count
        # strips behind the bay and where each ends; the last one ends where the next bay begins
        behind = (
            [(SPAR, 1, front + wing.web), (CAGE, 1, None)] if cage else [(SPAR, 1, None)],
            [(CAGE, 1, rear), (SPAR, 2, None)] if cage else [(SPAR, 2, None)],
            [(EDGE, 2, nose + chord)],
        )[panel]
        for kind, its_panel, border in behind:
            kinds.append(kind)
            panels.append(its_panel)
            if border is not None:
                borders.append(border)
    return _Columns(np.array(borders), np.array(kinds), np.array(panels))


def _heights(wing: WingGeometry, columns: _Columns, y: np.ndarray) -> np.ndarray:
    """z (columns + 1, rows + 1, layers + 1): skins of their thickness along the normals of the panels."""
    outer = wing.plan.height(columns.x, np.broadcast_to(y, columns.x.shape)) / 2
    slopes = np.array([wing.plan.panel_slopes(panel) for panel in range(3)])
    stretch = np.sqrt(1.0 + np.sum(slopes**2, axis=1))[columns.panel]
    # on the border of two panels the mean of both: the mitre of so flat an angle
    border = np.concatenate([stretch[:1], (stretch[1:] + stretch[:-1]) / 2, stretch[-1:]])
    depth = np.concatenate([[0.0], np.cumsum([layer.thickness for layer in wing.skin])])
    upper = outer[..., None] - border[:, None, None] * depth[::-1]
    return np.concatenate([-upper[..., ::-1], upper], axis=-1)


def _regions(wing: WingGeometry, columns: np.ndarray, rows: np.ndarray, inside: np.ndarray) -> np.ndarray:
    number = {name: i for i, name in enumerate(wing.regions)}
    layers = [number[layer.region] for layer in wing.skin]
    inner = np.full((len(columns), len(rows)), NOTHING)
    walls = np.flatnonzero(columns == CAGE)
    payload = np.zeros(inner.shape, dtype=bool)
    if len(walls):
        payload[walls[0] : walls[-1] + 1] = inside
    inner[np.broadcast_to(rows == RIB, inner.shape) & ~payload] = number[wing.web_region]
    if len(walls):
        of_cage = (columns == CAGE)[:, None] | (rows == CAGE)[None, :]
        inner[payload & of_cage] = number[wing.cage_region]
    inner[columns == SPAR] = number[wing.web_region]
    inner[columns == EDGE] = layers[0]
    region = np.empty((*inner.shape, 2 * len(layers) + 1), dtype=int)
    region[..., : len(layers)] = layers
    region[..., len(layers)] = inner
    region[..., len(layers) + 1 :] = layers[::-1]
    return region


def _axes(wing: WingGeometry, columns: _Columns, shape: tuple[int, ...]) -> np.ndarray:
    """Cloth lies in its panel, its angle counted from the span backwards; other materials along x, y, z."""
    found = np.broadcast_to(np.eye(3), (*shape, 3, 3)).copy()
    count = len(wing.skin)
    for column, panel in enumerate(columns.panel):
        dx, dy = wing.plan.panel_slopes(int(panel))
        for k, layer in enumerate(wing.skin):
            found[column, :, 2 * count - k] = _cloth(np.array([-dx, -dy, 1.0]), layer.angle)
            found[column, :, k] = _cloth(np.array([dx, dy, 1.0]), layer.angle)
        if columns.kind[column] == EDGE:
            normal = np.array([1.0, -np.tan(wing.plan.sweep), 0.0])
            found[column, :, count] = _cloth(normal, wing.skin[0].angle)
    return found


def _cloth(normal: np.ndarray, angle: float) -> np.ndarray:
    """Axes of cloth with a normal, as columns."""
    n = normal / np.linalg.norm(normal)
    span = np.array([0.0, 1.0, 0.0]) - n[1] * n
    span /= np.linalg.norm(span)
    back = np.cross(span, n)
    first = np.cos(angle) * span + np.sin(angle) * back
    return np.column_stack([first, np.cross(n, first), n])


def _count(cells: float, factor: float) -> int:
    return int(np.ceil(cells * factor - 1e-9))
