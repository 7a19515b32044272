"""Static responses of the symmetric stator to unit loads on the motions that springs and masses act on.

Y = (K + σM)⁻¹ Lᵀ over all harmonics. With them in the basis a spring's or a lump's own local field is exact, and modes
above the cut count only by their inertia. Every product of Y comes from those of the surface's unit loads, which are
solved once per problem (`statorhom.model.broken.sector`).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.linalg import block_diag

from statorhom.model.broken.basis import ProblemBasis, SymmetricBasis
from statorhom.model.broken.change import Attachment
from statorhom.model.broken.sector import Sector
from statorhom.model.broken.waves import Waves

_MIRROR = np.array([1.0, -1.0, 1.0])
DEPENDENT = 1e-24  # squared part of the largest stiffness or mass below which a motion carries neither

KEPT = 8  # places, and sets of them, whose responses are kept
OF_LOADS = ("rows", "products", "probed", "flexibility", "inertia")

Loads = Mapping[bool, np.ndarray]


@dataclass(frozen=True, eq=False)
class Statics:
    """All attachments together, on the motions L that carry springs or masses.

    Parameters
    ----------
    basis : of the symmetric stator.
    stiffness, mass : (a, a) of the attachments between the motions.
    loads : per problem: family → (s, a) unit loads Lᵀ on the coordinates that move the surface.
    """

    basis: SymmetricBasis
    stiffness: np.ndarray
    mass: np.ndarray
    loads: tuple[Loads, ...]

    def __len__(self) -> int:
        return len(self.stiffness)

    def with_(self, stiffness: np.ndarray, mass: np.ndarray) -> Statics:
        """The same motions with other springs and masses; what depends on the motions alone is kept."""
        found = replace(self, stiffness=stiffness, mass=mass)
        found.__dict__.update({name: self.__dict__[name] for name in OF_LOADS if name in self.__dict__})
        return found

    @cached_property
    def rows(self) -> np.ndarray:
        """LW of the basis, (a, coordinates)."""
        return self._stacked(lambda p: p.surface_parts[0].T).T

    @cached_property
    def products(self) -> np.ndarray:
        """WᵀMY, (coordinates, a)."""
        if len(self) == 0:
            return np.zeros(
                (len(self.basis.values), 0)
            )  # the surface's responses would be solved for nothing
        return self._stacked(lambda p: p.surface_products[0])

    @cached_property
    def probed(self) -> tuple[np.ndarray, np.ndarray]:
        """ζᵀLᵀ and ζᵀMY of the probes, (probes, a) each."""
        if len(self) == 0:
            return np.zeros((len(self.basis.probes), 0)), np.zeros((len(self.basis.probes), 0))
        return self._stacked(lambda p: p.surface_parts[1].T), self._stacked(lambda p: p.surface_products[1])

    @cached_property
    def flexibility(self) -> np.ndarray:
        """LY, (a, a)."""
        return self._summed(lambda s: s.flexibility)

    @cached_property
    def inertia(self) -> np.ndarray:
        """YᵀMY, (a, a)."""
        return self._summed(lambda s: s.inertia)

    @cached_property
    def responses(self) -> tuple[Loads, ...]:
        """Per problem: family → (m, a) coordinates of Y."""
        pairs = zip(self.basis.problems, self.loads, strict=True)
        return tuple({sine: p.sector.responses @ load for sine, load in loads.items()} for p, loads in pairs)

    @cached_property
    def waves(self) -> tuple[Waves, np.ndarray]:
        """The responses as columns of waves, and the coordinates (columns, a) of each response."""
        shapes: list[np.ndarray] = []
        order: list[int] = []
        chosen, count = {False: np.empty(0, int), True: np.empty(0, int)}, len(self)
        for problem, parts in zip(self.basis.problems, self.responses, strict=True):
            for sine, part in parts.items():
                chosen[sine] = np.r_[chosen[sine], len(shapes) * count + np.arange(count)]
                shapes.append(problem.sector.space.expand(part))
                order.append(problem.sector.space.order)
        columns = Waves(
            np.hstack(shapes), np.repeat(order, count), chosen[False], chosen[True], self.basis.mesh.slots
        )
        return columns, np.tile(np.eye(count), (len(shapes), 1))

    def _stacked(self, products: Callable[[ProblemBasis], np.ndarray]) -> np.ndarray:
        """Products (…, s) of every problem's surface times the loads, as rows of all coordinates."""
        blocks: dict[bool, list[np.ndarray]] = {False: [], True: []}
        for problem, loads in zip(self.basis.problems, self.loads, strict=True):
            for sine, load in loads.items():
                blocks[sine].append(products(problem) @ load)
        return np.vstack([*blocks[False], *blocks[True]])

    def _summed(self, products: Callable[[Sector], np.ndarray]) -> np.ndarray:
        total = np.zeros((len(self), len(self)))
        for problem, loads in zip(self.basis.problems, self.loads, strict=True):
            both = np.hstack(list(loads.values()))
            images = products(problem.sector) @ both
            for first in range(0, both.shape[1], max(len(self), 1)):
                part = slice(first, first + len(self))
                total += both[:, part].T @ images[:, part]
        return (total + total.T) / 2


def statics(basis: SymmetricBasis, attachments: Sequence[Attachment]) -> Statics:
    """Static responses to the attachments' loads; those at the same points as lately are not made again."""
    stiffness = block_diag(*[a.stiffness for a in attachments]) if attachments else np.zeros((0, 0))
    mass = block_diag(*[a.mass for a in attachments]) if attachments else np.zeros((0, 0))
    used = _carrying(stiffness, mass)
    if used is None:
        places = tuple(thing for a in attachments for thing in (a.points, a.rows))
        known = basis.kept_statics.get(tuple(map(id, places)))
        if known is not None:
            return known[1].with_(stiffness, mass)
        found = Statics(basis, stiffness, mass, _loads(basis, attachments, np.eye(len(stiffness))))
        # the places are kept too, so that their ids stay theirs
        basis.kept_statics[tuple(map(id, places))] = (places, found)
        if len(basis.kept_statics) > KEPT:
            basis.kept_statics.popitem(last=False)
        return found
    loads = _loads(basis, attachments, used)
    return Statics(basis, used.T @ stiffness @ used, used.T @ mass @ used, loads)


def _carrying(stiffness: np.ndarray, mass: np.ndarray) -> np.ndarray | None:
    """Orthonormal combinations (b, a) of the motions that carry a spring or a mass; None where all do."""
    total = np.zeros_like(mass)
    for part in (stiffness, mass):
        unit = part / max(np.abs(part).max(initial=0.0), np.finfo(float).tiny)
        total += unit @ unit.T
    values, vectors = np.linalg.eigh(total)
    keep = values > DEPENDENT * values.max(initial=0.0)
    return None if np.all(keep) else np.asarray(vectors[:, keep])


def _motion(basis: SymmetricBasis, a: Attachment) -> np.ndarray:
    """Displacements (motions, s) of an attachment's motions by the loaded coordinates of all problems, complex.

    Those of the latest places are kept: a support's springs stay where they are when a lump moves.
    """
    known = basis.kept_motions.get((id(a.points), id(a.rows)))
    if known is not None:
        basis.kept_motions.move_to_end((id(a.points), id(a.rows)))
        return np.asarray(known[1])
    found = _moved(basis, a)
    # the places are kept too, so that their ids stay theirs
    basis.kept_motions[id(a.points), id(a.rows)] = ((a.points, a.rows), found)
    if len(basis.kept_motions) > KEPT:
        basis.kept_motions.popitem(last=False)
    return found


def _moved(basis: SymmetricBasis, a: Attachment) -> np.ndarray:
    real, imaginary, order = basis.surface_motion
    surface = basis.problems[0].sector.surface
    local = a.points.matrix[:, surface].toarray()
    total = np.zeros((len(a.rows), len(order)), dtype=complex)
    places = {(int(k), bool(m)) for k, m in zip(a.points.pitch, a.points.mirrored, strict=True)}
    for pitch, mirrored in sorted(places):
        of = np.flatnonzero((a.points.pitch == pitch) & (a.points.mirrored == mirrored))
        rows = (3 * of[:, None] + np.arange(3)).ravel()
        sign = np.tile(_MIRROR, len(of))[:, None] if mirrored else 1.0
        here = a.rows[:, rows] @ (sign * local[rows])
        used = np.flatnonzero(np.any(here, axis=0))
        turn = np.exp(2j * np.pi / basis.mesh.slots * (order * pitch % basis.mesh.slots))
        other = here[:, used] @ imaginary[used]
        total += (here[:, used] @ real[used] + (-1j if mirrored else 1j) * other) * turn
    return total


def _loads(basis: SymmetricBasis, attachments: Sequence[Attachment], used: np.ndarray) -> tuple[Loads, ...]:
    """Unit loads on the motions; the motion's real part belongs to cosine, its imaginary part to sine shapes."""
    empty = np.zeros((0, len(basis.surface_motion[2])), dtype=complex)
    rows = (used.T @ np.vstack([empty, *(_motion(basis, a) for a in attachments)])).T
    both = {False: np.ascontiguousarray(rows.real), True: np.ascontiguousarray(rows.imag)}
    found, first = [], 0
    for problem in basis.problems:
        last = first + len(problem.sector.loaded)
        found.append({sine: both[sine][first:last] for sine in problem.sector.families})
        first = last
    return tuple(found)
