"""A reduced basis per harmonic over a box of materials: one evaluation never touches the full model.

The box is divided into cells of similar materials, and every cell has a small basis of its own (Eftang, Patera and
Rønquist 2010): a basis for everything from loose to bonded sheets, or from bare wires to cast resin, would hold
hundreds of vectors. The basis of a cell collects the modes of a few of its materials, each chosen where the certified
error is largest (greedy). The certificate is described in `eigenvalue_bounds`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from statorhom.mesh.hex_mesh import PartMesh
from statorhom.model.affine import AffineModel, Materials
from statorhom.model.basis_greedy import local_basis
from statorhom.model.blas_threads import one_blas_thread
from statorhom.model.harmonic_terms import harmonic_terms
from statorhom.model.local_basis import LocalBasis
from statorhom.model.material_cells import MaterialCells, material_cells
from statorhom.model.material_span import MaterialPoint, MaterialSpan, material_point, material_span
from statorhom.model.space import Space

RADIUS = 1.0  # of the cells: energies within one differ by about this much in their logarithm
MOST_CELLS = 12  # more make an evaluation faster and the bases dearer
# A cell is trained beyond its border, on materials that lie not much farther from its centre than from their own, and
# on a few of the nearest in any case: where materials are rare, a cell's own ones do not show what lies between.
OVERLAP, LEAST = 1.3, 12


@dataclass(frozen=True)
class MaterialBox:
    """Training materials divided into cells.

    Parameters
    ----------
    span : directions in which they move.
    cells : where a material belongs.
    training : per cell materials in and around it, the reference first.
    """

    span: MaterialSpan
    cells: MaterialCells
    training: tuple[tuple[MaterialPoint, ...], ...]


def material_box(
    training: Sequence[Materials],
    regions: Sequence[str],
    radius: float = RADIUS,
    most: int = MOST_CELLS,
    *,
    folded: bool = False,
) -> MaterialBox:
    """Divide materials that cover a box; the first is its centre; for `folded` see `material_span`."""
    points = [material_point(materials, regions) for materials in training]
    cells, centres = material_cells(points, radius, most)
    distance = np.array([cells.distances(point) for point in points])
    near = distance <= OVERLAP * distance.min(axis=1, keepdims=True)
    parts = []
    for cell, centre in enumerate(centres):
        order = np.argsort(distance[:, cell], kind="stable")
        chosen = [i for rank, i in enumerate(order) if i != centre and (near[i, cell] or rank < LEAST)]
        parts.append(tuple(points[i] for i in (centre, *chosen)))
    return MaterialBox(material_span(points, regions, folded=folded), cells, tuple(parts))


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
    """
    with one_blas_thread():
        terms = harmonic_terms(model, harmonic, box.span)
        cells = tuple(local_basis(terms, part, highest_hz, tolerance, most) for part in box.training)
    return ReducedHarmonic(harmonic, tuple(_frozen(cell) for cell in cells), highest_hz)


def _frozen(cell: LocalBasis) -> LocalBasis:
    for array in (cell.basis, cell.stiffness, cell.mass, cell.residual.factor, cell.residual.scales):
        np.asarray(array).setflags(write=False)
    return cell
