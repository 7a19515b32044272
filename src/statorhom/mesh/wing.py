"""20-node hexahedra of half a wing."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from statorhom.geometry.wing import WingGeometry
from statorhom.geometry.wing_lattice import NOTHING, WingLattice, wing_lattice
from statorhom.mesh.block import LOCAL
from statorhom.mesh.hex_mesh import PointMasses
from statorhom.mesh.mirror_mesh import MirrorMesh
from statorhom.study.wing_file import LUMPS


@dataclass(frozen=True, eq=False)
class WingMesh(MirrorMesh):
    """Mesh of the right half of a wing, y = 0 the plane of symmetry.

    Parameters
    ----------
    material_axes : (m, 3, 3) of the elements as columns, in components along x, y, z.
    upper : nodes of the upper face's corners, where accelerometers are.
    lump_elements, lump_places, lump_masses : see `PointMasses`; of this half.
    """

    material_axes: np.ndarray
    upper: np.ndarray
    lump_elements: np.ndarray
    lump_places: np.ndarray
    lump_masses: np.ndarray

    # Plies are a thousand times as wide as they are thick: at 3 × 3 × 3 points a bent panel of few cells locks, a tenth
    # too stiff. Two points an axis is where its strains are best (Barlow 1976, Int. J. Numer. Meth. Engng 10, 243).
    quadrature = 3

    def cell_axes(self, numbers: np.ndarray) -> np.ndarray:
        """Materials' axes of some elements."""
        return np.asarray(self.material_axes[numbers])

    def point_masses(self) -> PointMasses | None:
        """Lumps of this half."""
        if not len(self.lump_elements):
            return None
        return PointMasses(self.lump_elements, self.lump_places, self.lump_masses)


def wing_mesh(wing: WingGeometry, factor: float = 1.0) -> WingMesh:
    """Mesh the right half of a wing.

    Parameters
    ----------
    wing : its geometry.
    factor : refinement along chord and span.
    """
    lattice = wing_lattice(wing, factor)
    used = np.argwhere(lattice.region != NOTHING)
    places = (2 * used)[:, None, :] + LOCAL
    shape = tuple(2 * n + 1 for n in lattice.region.shape)
    flat = np.ravel_multi_index(tuple(np.moveaxis(places, -1, 0)), shape)
    numbers, elements = np.unique(flat, return_inverse=True)
    positions = _halved(lattice.corners)
    at = tuple(used.T)
    top = np.ravel_multi_index(np.ix_(range(0, shape[0], 2), range(0, shape[1], 2), [shape[2] - 1]), shape)
    return WingMesh(
        nodes=positions.reshape(-1, 3)[numbers],
        elements=elements.reshape(places.shape[:2]),
        region=lattice.region[at],
        regions=(*wing.regions, LUMPS) if wing.lumps else wing.regions,
        mirrors=((1, 0.0),),
        material_axes=lattice.axes[at],
        upper=np.searchsorted(numbers, np.unique(top)),
        **_lumps(wing, lattice),
    )


def _lumps(wing: WingGeometry, lattice: WingLattice) -> dict[str, np.ndarray]:
    """Elements of the upper skin below the lumps, places in them and masses of the right half."""
    number = np.full(lattice.region.shape, -1)
    number[lattice.region != NOTHING] = np.arange(np.count_nonzero(lattice.region != NOTHING))
    borders = lattice.corners[:, :, -1, :2]
    cells, places = [], np.empty((len(wing.lumps), 3))
    for i, lump in enumerate(wing.lumps):
        row, across = _between(borders[0, :, 1], lump.y)
        edges = borders[:, row, 0] * (1 - across) + borders[:, row + 1, 0] * across
        column, along = _between(edges, lump.x)
        cells.append(number[column, row, -1])
        places[i] = along, across, 1.0
    return {
        "lump_elements": np.array(cells, dtype=int),
        "lump_places": places,
        # half of what stands in the middle is the other half's
        "lump_masses": np.array([lump.mass * lump.copies / 2 for lump in wing.lumps]),
    }


def _between(borders: np.ndarray, value: float) -> tuple[int, float]:
    """Number of the interval that holds a value, and where in it, 0 … 1."""
    i = int(np.clip(np.searchsorted(borders, value, side="right") - 1, 0, len(borders) - 2))
    return i, float(np.clip((value - borders[i]) / (borders[i + 1] - borders[i]), 0.0, 1.0))


def _halved(corners: np.ndarray) -> np.ndarray:
    """Corners with the middles between neighbours along every axis."""
    found = corners
    for axis in range(3):
        shape = list(found.shape)
        shape[axis] = 2 * shape[axis] - 1
        finer = np.empty(shape)
        at = [slice(None)] * 4
        whole = np.moveaxis(found, axis, 0)
        at[axis] = slice(0, None, 2)
        finer[tuple(at)] = found
        at[axis] = slice(1, None, 2)
        finer[tuple(at)] = np.moveaxis((whole[1:] + whole[:-1]) / 2, 0, axis)
        found = finer
    return found
