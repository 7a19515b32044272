"""Elements cut into radial layers, for a stiffness that differs in a part of an element's depth.

A soft strip that covers half of an element as if the whole were a little softer leaves the yoke far too stiff in
bending, which asks how far from the middle the soft part lies. Integrated layer by layer, the element's own shape
functions take it into account.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache

import numpy as np

from statorhom.mesh.hex_mesh import HalfPitchMesh
from statorhom.model.assembly import CHUNK, element_geometry, stiffness_blocks
from statorhom.model.broken.cells import Cells, cells
from statorhom.model.broken.pieces import Pieces, element_dofs, elements_in
from statorhom.model.element import REFERENCE_NODES, ShapeTable, layer_table


@dataclass(frozen=True, eq=False)
class Layers:
    """Radial layers of some elements.

    Parameters
    ----------
    pieces : stiffness of every layer, all layers of an element one after the other.
    place : where they lie.
    outer : radius of the core (m).
    """

    pieces: Pieces
    place: Cells
    outer: float


def radial_layers(
    mesh: HalfPitchMesh, region: str, hooke: np.ndarray, count: int, inner: float = 0.0
) -> Layers:
    """Elements of a region in layers of equal thickness.

    Parameters
    ----------
    hooke : nine Hooke entries (Pa).
    count : layers an element.
    inner : radius (m) within which elements are left out.
    """
    numbers = elements_in(mesh, (region,))
    numbers = numbers[cells(mesh, numbers).radius[:, 1] > inner]
    nodes = mesh.nodes[mesh.elements[numbers]]
    rise = _rise(nodes)
    axis = np.argmax(np.abs(rise), axis=1)
    matrices = np.empty((len(numbers), count, 60, 60))
    for along in range(3):
        for first in range(0, len(places := np.flatnonzero(axis == along)), CHUNK):
            part = places[first : first + CHUNK]
            for layer in range(count):
                matrices[part, layer] = _stiffness(nodes[part], hooke, _table(along, layer, count))
    dofs = np.repeat(element_dofs(mesh, numbers), count, axis=0)
    pieces = Pieces(dofs, matrices.reshape(-1, 60, 60), 3 * len(mesh.nodes))
    upwards = rise[np.arange(len(numbers)), axis] > 0
    return Layers(pieces, _layered(cells(mesh, numbers), upwards, count), mesh.outer_radius)


def _rise(nodes: np.ndarray) -> np.ndarray:
    """By how much the radius grows along each axis of the reference cube, (e, 3)."""
    radius = np.hypot(nodes[..., 0], nodes[..., 1])
    return np.stack(
        [
            radius[:, REFERENCE_NODES[:, axis] == 1.0].mean(axis=1)
            - radius[:, REFERENCE_NODES[:, axis] == 0.0].mean(axis=1)
            for axis in range(3)
        ],
        axis=1,
    )


@cache
def _table(axis: int, layer: int, count: int) -> ShapeTable:
    return layer_table(axis, layer / count, (layer + 1) / count)


def _stiffness(nodes: np.ndarray, hooke: np.ndarray, table: ShapeTable) -> np.ndarray:
    terms = zip(hooke, stiffness_blocks(element_geometry(nodes, table)), strict=True)
    return np.asarray(sum(factor * block for factor, block in terms))


def _layered(place: Cells, upwards: np.ndarray, count: int) -> Cells:
    """Extents of the layers; their numbers follow the reference cube's axis, which may point inwards."""
    low, high = place.radius.T
    steps = np.arange(count) / count
    begin = np.where(upwards[:, None], steps, 1.0 - steps - 1.0 / count)
    thick = (high - low)[:, None]
    radius = np.stack([low[:, None] + begin * thick, low[:, None] + (begin + 1.0 / count) * thick], axis=-1)
    angle, z = (np.repeat(extent, count, axis=0) for extent in (place.angle, place.z))
    return replace(place, angle=angle, radius=radius.reshape(-1, 2), z=z)
