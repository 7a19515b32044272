"""The materials that a reduced basis knows: a few combinations of Hooke entries per region.

A transversely isotropic region moves in five directions of the nine-dimensional space of Hooke entries, an isotropic
one in two, and regions that always are of one material, as slots and overhang mostly are, move together: operators are
projected once per direction, not per entry and region.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from statorhom.errors import SolverError
from statorhom.model.affine import Materials, hooke_coefficients
from statorhom.model.assembly import HOOKE_ENTRIES

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

    @property
    def normal_blocks(self) -> np.ndarray:
        """Hooke's matrices of the normal strains (regions, 3, 3)."""
        return self.hooke[:, [0, 3, 4, 3, 1, 5, 4, 5, 2]].reshape(-1, 3, 3)

    @cached_property
    def normal_root(self) -> np.ndarray:
        """Inverse Cholesky factors of these: everything is measured against a few references."""
        return np.linalg.inv(np.linalg.cholesky(self.normal_blocks))


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
    groups : regions that move together, by their first one.
    entries : first region of a group → (s,) the Hooke entries that determine the others.
    directions : first region of a group → (9, s) all Hooke entries per unit of these.
    """

    regions: tuple[str, ...]
    groups: Mapping[str, tuple[str, ...]]
    entries: Mapping[str, np.ndarray]
    directions: Mapping[str, np.ndarray]

    @property
    def size(self) -> int:
        """Number of directions of all groups."""
        return sum(len(e) for e in self.entries.values())

    def weights(self, point: MaterialPoint) -> np.ndarray:
        """Weights of the directions (size,): the determining Hooke entries of all groups (Pa).

        Raises
        ------
        SolverError
            If a material is of another kind than those that the basis was trained on.
        """
        hooke = dict(zip(self.regions, point.hooke, strict=True))
        found = []
        for first, members in self.groups.items():
            weight = hooke[first][self.entries[first]]
            spanned = self.directions[first] @ weight
            for region in members:
                if np.abs(spanned - hooke[region]).max() > OUTSIDE * np.abs(hooke[region]).max():
                    raise SolverError(
                        f"region {region!r}: its material has another symmetry than those of the reduced basis, or "
                        "is no longer that of a region that shared it; build a basis for it"
                    )
            found.append(weight)
        return np.concatenate(found)

    def hooke_gradients(self, gradient: np.ndarray) -> dict[str, np.ndarray]:
        """Region → derivative with respect to its nine entries, from that with respect to the weights (size,).

        All of it is put on the determining entries of a group's first region: right for every change of material
        within the span, and no other can happen.
        """
        found = {region: np.zeros(len(HOOKE_ENTRIES)) for region in self.regions}
        start = 0
        for first, entries in self.entries.items():
            found[first][entries] = gradient[start : start + len(entries)]
            start += len(entries)
        return found


def material_span(
    points: Sequence[MaterialPoint], regions: Sequence[str], *, folded: bool = False
) -> MaterialSpan:
    """The narrowest symmetry of every region that holds all its materials.

    Parameters
    ----------
    points, regions : materials and the order of their numbers.
    folded : a material that is the same at all points is one direction, and woven cloth six instead of nine. Materials
        outside, and derivatives with respect to constants that never moved alone, are then out of reach.
    """
    hooke = {region: np.array([p.hooke[i] for p in points]) for i, region in enumerate(regions)}
    groups = _groups(hooke)
    chosen = {first: _narrowest(hooke[first], folded) for first in groups}
    return MaterialSpan(
        tuple(regions), groups, {r: c[0] for r, c in chosen.items()}, {r: c[1] for r, c in chosen.items()}
    )


def _groups(hooke: Mapping[str, np.ndarray]) -> dict[str, tuple[str, ...]]:
    """Regions of one material at every point, by their first one."""
    found: dict[str, tuple[str, ...]] = {}
    for region, values in hooke.items():
        first = next((f for f in found if np.array_equal(hooke[f], values)), region)
        found[first] = (*found.get(first, ()), region)
    return found


def _narrowest(hooke: np.ndarray, folded: bool) -> tuple[np.ndarray, np.ndarray]:
    size = np.abs(hooke).max(axis=1, keepdims=True)
    if folded and np.array_equal(hooke, np.broadcast_to(hooke[0], hooke.shape)):
        return np.array([0]), hooke[0][:, None] / hooke[0, 0]
    return next(
        (entries, directions)
        for entries, directions in (FOLDED if folded else SYMMETRIES)
        if np.all(np.abs(hooke[:, entries] @ directions.T - hooke) <= OUTSIDE * size)
    )


def _symmetry(*columns: Mapping[str, float]) -> tuple[np.ndarray, np.ndarray]:
    """Determining entries, the first of every column, and all entries per unit of each."""
    directions = np.zeros((len(HOOKE_ENTRIES), len(columns)))
    for j, column in enumerate(columns):
        for name, value in column.items():
            directions[HOOKE_ENTRIES.index((int(name[0]) - 1, int(name[1]) - 1)), j] = value
    entries = [int(np.flatnonzero(column == 1.0)[0]) for column in directions.T]
    return np.array(entries), directions


# isotropic, transversely isotropic about axis 3, orthotropic: each holds those before it
SYMMETRIES = (
    _symmetry(
        {"11": 1, "22": 1, "33": 1, "44": 0.5, "55": 0.5, "66": 0.5},
        {"12": 1, "13": 1, "23": 1, "44": -0.5, "55": -0.5, "66": -0.5},
    ),
    _symmetry(
        {"11": 1, "22": 1, "66": 0.5},
        {"33": 1},
        {"12": 1, "66": -0.5},
        {"13": 1, "23": 1},
        {"44": 1, "55": 1},
    ),
    _symmetry(*({f"{i + 1}{j + 1}": 1.0} for i, j in HOOKE_ENTRIES)),
)
# woven cloth, stiff alike along 1 and 2, lies between the last two
WOVEN = _symmetry({"11": 1, "22": 1}, {"33": 1}, {"12": 1}, {"13": 1, "23": 1}, {"44": 1, "55": 1}, {"66": 1})
FOLDED = (*SYMMETRIES[:-1], WOVEN, SYMMETRIES[-1])
