"""A reduced basis per harmonic over a box of materials: one evaluation never touches the full model.

The box is divided into cells of similar materials, and every cell has a small basis of its own (Eftang, Patera and
Rønquist 2010): a basis for everything from loose to bonded sheets, or from bare wires to cast resin, would hold
hundreds of vectors. The basis of a cell collects the modes of a few of its materials, each chosen where the certified
error is largest (greedy). A cell may be divided again into rooms, each with as few combinations of these vectors as
its own materials need: that costs no further solution of the full model, and evaluations become cheaper still. The
certificate is described in `eigenvalue_bounds`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from statorhom.mesh.hex_mesh import PartMesh
from statorhom.model.affine import AffineModel, Materials
from statorhom.model.basis_greedy import local_basis
from statorhom.model.blas_threads import one_blas_thread
from statorhom.model.common_snapshots import Snapshots
from statorhom.model.harmonic_terms import harmonic_terms
from statorhom.model.local_basis import LocalBasis
from statorhom.model.material_cells import Division, MaterialCells, divided, features
from statorhom.model.material_span import MaterialPoint, MaterialSpan, material_point, material_span
from statorhom.model.space import Space

RADIUS = 1.0  # of the cells: energies within one differ by about this much in their logarithm
MOST_CELLS = 12  # more make an evaluation faster and the bases dearer


@dataclass(frozen=True)
class MaterialBox:
    """Training materials divided into cells, and every cell into rooms.

    Parameters
    ----------
    span : directions in which they move.
    cells : where a material belongs.
    training : per cell materials in and around it, the reference first.
    rooms : per cell the division of its training materials.
    """

    span: MaterialSpan
    cells: MaterialCells
    training: tuple[tuple[MaterialPoint, ...], ...]
    rooms: tuple[Division, ...]

    def locate(self, point: MaterialPoint) -> tuple[int, int]:
        """Numbers of a material's cell and of its room there."""
        described = features(point)
        cell = self.cells.locate(described)
        return cell, self.rooms[cell].cells.locate(described)


def material_box(
    training: Sequence[Materials],
    regions: Sequence[str],
    radius: float = RADIUS,
    most: int = MOST_CELLS,
    *,
    room_radius: float = np.inf,
    folded: bool = False,
) -> MaterialBox:
    """Divide materials that cover a box.

    Parameters
    ----------
    training : materials; the first is the middle of the box.
    regions : in the order of all arrays.
    radius, most : of the cells, and how many at most.
    room_radius : of the rooms; infinite for cells of one room each.
    folded : see `material_span`.
    """
    points = [material_point(materials, regions) for materials in training]
    division = divided(points, radius, most)
    parts = tuple(tuple(points[i] for i in members) for members in division.members)
    rooms = tuple(divided(part, room_radius, len(part)) for part in parts)
    return MaterialBox(material_span(points, regions, folded=folded), division.cells, parts, rooms)


@dataclass(frozen=True)
class ReducedHarmonic:
    """One harmonic in its reduced bases.

    Parameters
    ----------
    harmonic : the full space.
    cells : basis of every cell of the box.
    highest_hz : upper end of the band in which it is certified.
    """

    harmonic: Space
    cells: tuple[LocalBasis, ...]
    highest_hz: float

    @property
    def error(self) -> float:
        """Largest certified relative frequency error at the training materials."""
        return max((cell.error for cell in self.cells), default=0.0)


def reduce_harmonic(
    model: AffineModel[PartMesh],
    harmonic: Space,
    box: MaterialBox,
    highest_hz: float,
    tolerance: float = 3e-4,
    most: int = 60,
    known: Sequence[Snapshots] = (),
) -> ReducedHarmonic:
    """Build the reduced bases of a harmonic.

    Parameters
    ----------
    model : the affine model.
    harmonic : the harmonic's space.
    box : materials.
    highest_hz : modes up to here are to be exact.
    tolerance : certified relative frequency error to stay below at all training materials.
    most : largest number of snapshots of a cell.
    known : per cell the modes that are known already; may be empty.
    """
    known = known or ({},) * len(box.training)
    with one_blas_thread():
        terms = harmonic_terms(model, harmonic, box.span)
        cells = tuple(
            local_basis(terms, part, rooms.members, highest_hz, tolerance, most, snapshots)
            for part, rooms, snapshots in zip(box.training, box.rooms, known, strict=True)
        )
    for cell in cells:
        for array in cell.arrays:
            array.setflags(write=False)
    return ReducedHarmonic(harmonic, cells, highest_hz)
