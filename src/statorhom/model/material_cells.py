"""Materials divided into cells: within one they are alike, so that a small basis serves all of it.

Two materials are as far apart as the logarithms of their stiffnesses, the largest difference of all directions and
regions: within a radius ρ energies differ by a factor of about e^ρ at most.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from statorhom.model.material_span import MaterialPoint

DIAGONAL = [0, 1, 2, 6, 7, 8]  # of the nine Hooke entries
# A cell is trained beyond its border, on materials that lie not much farther from its centre than from their own, and
# on a few of the nearest in any case: where materials are rare, a cell's own ones do not show what lies between.
OVERLAP, LEAST = 1.3, 12
COUPLED = ((3, 0, 1), (4, 0, 2), (5, 1, 2))  # an off-diagonal entry and the two diagonal ones that bound it


def features(point: MaterialPoint) -> np.ndarray:
    """What distances are measured in: logarithms of diagonal entries, and the off-diagonal ones over them."""
    hooke = point.hooke
    ratios = [hooke[:, q] / np.sqrt(hooke[:, i] * hooke[:, j]) for q, i, j in COUPLED]
    return np.concatenate([np.log(hooke[:, DIAGONAL]).ravel(), *ratios, np.log(point.density)])


def stiffness_ratio(point: MaterialPoint, reference: MaterialPoint) -> float:
    """Largest α with K + σM ≥ α (K + σM of the reference), for every mesh and every shift σ ≥ 0."""
    root = reference.normal_root
    normal = np.linalg.eigvalsh(root @ point.normal_blocks @ root.transpose(0, 2, 1)).min()
    shear = (point.hooke[:, 6:] / reference.hooke[:, 6:]).min()
    return float(min(normal, shear, (point.density / reference.density).min()))


@dataclass(frozen=True)
class MaterialCells:
    """Cells around centres: a material belongs to the nearest.

    Parameters
    ----------
    centres : (cells, features).
    """

    centres: np.ndarray

    def locate(self, described: np.ndarray) -> int:
        """Number of the cell of a material's features."""
        return int(self.distances(described).argmin())

    def distances(self, described: np.ndarray) -> np.ndarray:
        """Distances of materials (…, features) to all centres, (…, cells)."""
        return np.asarray(np.abs(self.centres - described[..., None, :]).max(axis=-1))


@dataclass(frozen=True)
class Division:
    """Materials divided into cells.

    Parameters
    ----------
    cells : where a material belongs.
    members : per cell the numbers of the materials in and around it, the one in its middle first.
    """

    cells: MaterialCells
    members: tuple[tuple[int, ...], ...]


def divided(points: Sequence[MaterialPoint], radius: float, most: int) -> Division:
    """Divide materials, the first of which is the middle of the first cell."""
    described = np.array([features(p) for p in points])
    cells, centres = material_cells(described, radius, most)
    distance = cells.distances(described)
    near = distance <= OVERLAP * distance.min(axis=1, keepdims=True)
    members = []
    for cell, centre in enumerate(centres):
        order = np.argsort(distance[:, cell], kind="stable").tolist()
        around = [i for rank, i in enumerate(order) if i != centre and (near[i, cell] or rank < LEAST)]
        members.append((centre, *around))
    return Division(cells, tuple(members))


def material_cells(described: np.ndarray, radius: float, most: int) -> tuple[MaterialCells, list[int]]:
    """Cells that cover materials of given features, and the number of the material in the middle of each.

    The next centre is the material farthest from all centres (Gonzalez 1985: at most twice the best radius), until
    none is farther than `radius` or there are `most` cells.
    """
    chosen = [0]
    distance = np.abs(described - described[0]).max(axis=1)
    while distance.max() > radius and len(chosen) < most:
        chosen.append(int(distance.argmax()))
        distance = np.minimum(distance, np.abs(described - described[chosen[-1]]).max(axis=1))
    return MaterialCells(described[chosen]), chosen
