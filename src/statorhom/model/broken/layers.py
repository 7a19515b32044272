"""Elements cut into radial layers and by height, for a stiffness that differs within an element.

A soft strip that covers half of an element as if the whole were a little softer leaves the yoke far too stiff in
bending, which asks how far from the middle the soft part lies. Integrated layer by layer, the element's own shape
functions take it into account. One of four elements along a core reaches over a quarter of it and more: if all of it
had the stiffness of its middle, a gradient along the axis would tilt shapes by a fifth less than it does.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache

import numpy as np

from statorhom.mesh.hex_mesh import HalfPitchMesh
from statorhom.model.assembly import CHUNK, element_geometry, stiffness_of
from statorhom.model.broken.cells import Cells, cells
from statorhom.model.broken.pieces import Pieces, element_dofs, elements_in
from statorhom.model.element import REFERENCE_NODES, ShapeTable, gauss_table, layer_table


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
    mesh: HalfPitchMesh,
    region: str,
    hooke: np.ndarray,
    count: int,
    inner: float = 0.0,
    *,
    by_height: bool = False,
) -> Layers:
    """Elements of a region in layers of equal thickness.

    Parameters
    ----------
    hooke : nine Hooke entries (Pa).
    count : layers an element.
    inner : radius (m) within which elements are left out.
    by_height : Gauss points of every height of a layer apart, for what varies along the axis too.
    """
    numbers = elements_in(mesh, (region,))
    numbers = numbers[cells(mesh, numbers).radius[:, 1] > inner]
    nodes = mesh.nodes[mesh.elements[numbers]]
    rise = _rise(nodes)
    axis = np.argmax(np.abs(rise), axis=1)
    matrices = _matrices(nodes, axis, hooke, count, by_height=by_height)
    dofs = np.repeat(element_dofs(mesh, numbers), matrices.shape[1], axis=0)
    pieces = Pieces(dofs, matrices.reshape(-1, 60, 60), 3 * len(mesh.nodes))
    upwards = rise[np.arange(len(numbers)), axis] > 0
    place = _layered(cells(mesh, numbers), upwards, count)
    return Layers(pieces, _at_heights(place, nodes) if by_height else place, mesh.outer_radius)


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


def _matrices(
    nodes: np.ndarray, axis: np.ndarray, hooke: np.ndarray, count: int, *, by_height: bool
) -> np.ndarray:
    """Stiffness of all parts of elements, (e, p, 60, 60), one layer after the other; `axis`: (e,) the radial one."""
    tables = [_tables(along, count, by_height) for along in range(3)]
    found = np.empty((len(nodes), len(tables[0]), 60, 60))
    for along, own in enumerate(tables):
        places = np.flatnonzero(axis == along)
        for first in range(0, len(places), CHUNK):
            part = places[first : first + CHUNK]
            for k, table in enumerate(own):
                found[part, k] = stiffness_of(element_geometry(nodes[part], table), hooke)
    return found


@cache
def _tables(axis: int, count: int, by_height: bool) -> tuple[ShapeTable, ...]:
    layers = [layer_table(axis, layer / count, (layer + 1) / count) for layer in range(count)]
    return tuple(part for layer in layers for part in (layer.by_height() if by_height else (layer,)))


def _layered(place: Cells, upwards: np.ndarray, count: int) -> Cells:
    """Extents of the layers; their numbers follow the reference cube's axis, which may point inwards."""
    low, high = place.radius.T
    steps = np.arange(count) / count
    begin = np.where(upwards[:, None], steps, 1.0 - steps - 1.0 / count)
    thick = (high - low)[:, None]
    radius = np.stack([low[:, None] + begin * thick, low[:, None] + (begin + 1.0 / count) * thick], axis=-1)
    angle, z = (np.repeat(extent, count, axis=0) for extent in (place.angle, place.z))
    return replace(place, angle=angle, radius=radius.reshape(-1, 2), z=z)


def _at_heights(place: Cells, nodes: np.ndarray) -> Cells:
    """Extents of layers whose Gauss points of every height are apart."""
    tables = gauss_table().by_height()
    heights = np.stack([(nodes[..., 2] @ table.values.T).mean(axis=1) for table in tables], axis=1)
    layers = len(place.z) // len(nodes)
    z = np.repeat(heights, layers, axis=0).reshape(-1)
    angle, radius = (np.repeat(extent, heights.shape[1], axis=0) for extent in (place.angle, place.radius))
    return replace(place, angle=angle, radius=radius, z=np.stack([z, z], axis=-1))
