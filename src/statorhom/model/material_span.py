"""The materials that a reduced basis knows: a few combinations of Hooke entries per region.

A transversely isotropic region moves in five directions of the nine-dimensional space of Hooke entries, an isotropic
one in two. The directions come from the training materials; operators are projected once per direction, not per entry.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.linalg import qr

from statorhom.errors import SolverError
from statorhom.model.affine import Materials, hooke_coefficients
from statorhom.model.assembly import HOOKE_ENTRIES

RANK = 1e-9  # relative singular value below which a direction is rounding
OUTSIDE = 1e-6  # relative part of a Hooke's matrix that may lie outside the span


@dataclass(frozen=True)
class MaterialPoint:
    """Materials as numbers, regions in a fixed order.

    Parameters
    ----------
    hooke : (regions, 9) Hooke entries (Pa).
    density : (regions,) kg/m³.
    """

    hooke: np.ndarray
    density: np.ndarray


def material_point(materials: Materials, regions: Sequence[str]) -> MaterialPoint:
    """Numbers of the regions' materials; a material that several regions share is read once."""
    entries = {id(materials[r]): hooke_coefficients(materials[r].hooke) for r in regions}
    return MaterialPoint(
        np.array([entries[id(materials[r])] for r in regions]),
        np.array([materials[r].density for r in regions]),
    )


@dataclass(frozen=True)
class MaterialSpan:
    """Directions in which the regions' Hooke entries move.

    Parameters
    ----------
    regions : in the order of all arrays.
    entries : region → (s,) the Hooke entries that determine the others.
    directions : region → (9, s) all Hooke entries per unit of these.
    """

    regions: tuple[str, ...]
    entries: Mapping[str, np.ndarray]
    directions: Mapping[str, np.ndarray]

    @property
    def size(self) -> int:
        """Number of directions of all regions."""
        return sum(len(e) for e in self.entries.values())

    def weights(self, point: MaterialPoint) -> np.ndarray:
        """Weights of the directions (size,): the determining Hooke entries of all regions (Pa).

        Raises
        ------
        SolverError
            If a material is of another kind than those that the basis was trained on.
        """
        found = []
        for hooke, region in zip(point.hooke, self.regions, strict=True):
            weight = hooke[self.entries[region]]
            if np.abs(self.directions[region] @ weight - hooke).max() > OUTSIDE * np.abs(hooke).max():
                raise SolverError(
                    f"region {region!r}: its material has another symmetry than those of the reduced basis; "
                    "build a basis for it"
                )
            found.append(weight)
        return np.concatenate(found)

    def hooke_gradients(self, gradient: np.ndarray) -> dict[str, np.ndarray]:
        """Region → derivative with respect to its nine entries, from that with respect to the weights (size,).

        All of it is put on the determining entries: right for every change of material within the span, and no
        other can happen.
        """
        found, first = {}, 0
        for region in self.regions:
            entries = self.entries[region]
            found[region] = np.zeros(len(HOOKE_ENTRIES))
            found[region][entries] = gradient[first : first + len(entries)]
            first += len(entries)
        return found


def material_span(points: Sequence[MaterialPoint], regions: Sequence[str]) -> MaterialSpan:
    """Span of training materials, region by region: regions may then also move apart."""
    chosen, directions = {}, {}
    for i, region in enumerate(regions):
        hooke = np.array([p.hooke[i] for p in points])
        # of equal size, lest soft materials drown as rounding of stiff ones
        rows = hooke / np.linalg.norm(hooke, axis=1)[:, None]
        _, values, right = np.linalg.svd(rows, full_matrices=False)
        kept = right[values > RANK * values[0]]
        # the reduced echelon form keeps stiff and soft entries apart
        _, _, pivots = qr(kept, mode="economic", pivoting=True)
        chosen[region] = np.sort(pivots[: len(kept)])
        directions[region] = np.linalg.solve(kept[:, chosen[region]], kept).T
        directions[region][np.abs(directions[region]) < RANK] = 0.0
    return MaterialSpan(tuple(regions), chosen, directions)
