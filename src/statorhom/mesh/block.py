"""An eighth of a plate or beam, cut into a grid of hexahedra."""

from __future__ import annotations

import math

import numpy as np

from statorhom.geometry.block import BlockGeometry
from statorhom.mesh.mirror_mesh import MirrorMesh

# Cells along half of the longest side on the coarsest mesh, fewer where an eighth would have more than `MOST`. The
# other sides have cells of the same size, as many as it takes; quadratic ones represent half a bending wave with two.
LONGEST, MOST = 24, 120
# How many times longer cells are at the middle than at the free edges, in the limit of many cells: within a thickness
# of an edge, twisting sections warp.
GRADING = 3.0


def block_mesh(block: BlockGeometry, factor: float = 1.0) -> MirrorMesh:
    """Mesh the eighth of a block that begins at its corner in the origin.

    Parameters
    ----------
    block : its geometry.
    factor : refinement; multiplies all numbers of cells.
    """
    half = np.array(block.size) / 2
    cells = [math.floor(c * factor + 0.5) if c > 1 else 1 for c in _coarsest(half)]
    nodes, elements = _grid(half, cells)
    mirrors = tuple((axis, float(position)) for axis, position in enumerate(half))
    return MirrorMesh(nodes, elements, np.zeros(len(elements), dtype=int), block.regions, mirrors)


def _coarsest(half: np.ndarray) -> list[int]:
    """Cells along half of every side."""
    trials = [_counts(half, longest) for longest in range(LONGEST, 2, -2)]
    return next((counts for counts in trials if math.prod(counts) <= MOST), trials[-1])


def _counts(half: np.ndarray, longest: int) -> list[int]:
    """Even numbers, so that one and a half times as many are a similar mesh; or one, which stays one.

    Half the thickness of a plate is one quadratic cell: a second one changes frequencies by 0.01 %. A bar that is thin
    both ways has two each way, for the warping of its section in torsion.
    """
    counts = [math.ceil(side / (half.max() / longest) - 1e-9) for side in half]
    if counts.count(1) == 1:
        return [count + count % 2 if count > 1 else 1 for count in counts]
    return [count + count % 2 for count in counts]


def _levels(side: float, cells: int) -> np.ndarray:
    """Positions of corners and mid-sides along half a side, cells growing from its free edge."""
    share = np.linspace(0.0, 1.0, cells + 1)
    corners = side * (GRADING**share - 1.0) / (GRADING - 1.0)
    corners[-1] = side  # exactly on the plane of symmetry
    levels = np.empty(2 * cells + 1)
    levels[::2], levels[1::2] = corners, (corners[1:] + corners[:-1]) / 2
    return levels


def _grid(half: np.ndarray, cells: list[int]) -> tuple[np.ndarray, np.ndarray]:
    """Nodes and elements of a box 0 … half with a number of cells along each axis."""
    counts = [2 * c + 1 for c in cells]  # corners and mid-sides along each axis
    index = np.stack(np.meshgrid(*(np.arange(c) for c in counts), indexing="ij"), axis=-1).reshape(-1, 3)
    # of a 20-node brick no node lies at the middle of a face or of the cell
    used = (index % 2).sum(axis=1) <= 1
    number = np.full(counts, -1)
    number[tuple(index[used].T)] = np.arange(int(used.sum()))
    levels = [_levels(side, count) for side, count in zip(half, cells, strict=True)]
    nodes = np.column_stack([level[place] for level, place in zip(levels, index[used].T, strict=True)])
    first = 2 * np.stack(np.meshgrid(*(np.arange(c) for c in cells), indexing="ij"), axis=-1).reshape(-1, 3)
    corners = first[:, None, :] + LOCAL
    return nodes, number[corners[..., 0], corners[..., 1], corners[..., 2]]


_CORNERS = np.array([[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0], [0, 0, 2], [2, 0, 2], [2, 2, 2], [0, 2, 2]])
_EDGES = [(0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (1, 5), (2, 6), (3, 7), (4, 5), (5, 6), (6, 7), (7, 4)]
# positions of an element's nodes in half cells, in the local numbering of `hex_mesh`
LOCAL = np.vstack([_CORNERS, [(_CORNERS[a] + _CORNERS[b]) // 2 for a, b in _EDGES]])
