"""Static responses of the symmetric stator to unit loads on the motions that springs and masses act on.

Y = (K + σM)⁻¹ Lᵀ over all harmonics. With them in the basis a spring's or a lump's own local field is exact, and modes
above the cut count only by their inertia. Every product of Y comes from those of the surface's unit loads, which are
solved once for all problems (`statorhom.model.cyclic.unit_loads`).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.linalg import block_diag

from statorhom.model.broken.basis import SymmetricBasis
from statorhom.model.broken.change import Attachment
from statorhom.model.broken.copies import MovedCopies
from statorhom.model.broken.pieces import Pieces
from statorhom.model.broken.problem_basis import ProblemBasis
from statorhom.model.broken.surface_answers import Answers
from statorhom.model.broken.waves import Waves

DEPENDENT = 1e-24  # squared part of the largest stiffness or mass below which a motion carries neither

Loads = Mapping[bool, np.ndarray]


@dataclass(frozen=True, eq=False)
class StaticResponses:
    """To unit loads on some motions: all that springs and masses of whatever size on them share.

    The basis keeps those of the latest places, so they do not hold the basis: two that hold each other are freed only
    when Python looks for cycles, and these are large.

    Parameters
    ----------
    problems : of the symmetric stator, with their bases.
    slots : number of slot pitches.
    loaded : (problems, s, 2, a) unit loads Lᵀ, as `SurfaceAnswers.loads` has them.
    answers : to the unit loads.
    """

    problems: tuple[ProblemBasis, ...]
    slots: int
    loaded: np.ndarray
    answers: Answers

    def __len__(self) -> int:
        return int(self.loaded.shape[-1])

    @cached_property
    def loads(self) -> tuple[Loads, ...]:
        """Per problem: family → (s, a) unit loads on the coordinates that move the surface."""
        sectors = [p.sector for p in self.problems]
        return tuple(
            {sine: own[: len(sector.loaded), int(sine)] for sine in sector.families}
            for own, sector in zip(self.loaded, sectors, strict=True)
        )

    @cached_property
    def responses(self) -> tuple[Loads, ...]:
        """Per problem: family → (m, a) coordinates of Y."""
        pairs = zip(self.problems, self.loads, strict=True)
        return tuple(
            {sine: p.sector.answers.responses @ load for sine, load in loads.items()} for p, loads in pairs
        )

    @cached_property
    def waves(self) -> tuple[Waves, np.ndarray]:
        """The responses as columns of waves, and the coordinates (columns, a) of each response."""
        shapes: list[np.ndarray] = []
        order: list[int] = []
        chosen, count = {False: np.empty(0, int), True: np.empty(0, int)}, len(self)
        for problem, parts in zip(self.problems, self.responses, strict=True):
            for sine, part in parts.items():
                chosen[sine] = np.r_[chosen[sine], len(shapes) * count + np.arange(count)]
                shapes.append(problem.sector.space.expand(part))
                order.append(problem.sector.space.order)
        columns = Waves(np.hstack(shapes), np.repeat(order, count), chosen[False], chosen[True], self.slots)
        return columns, np.tile(np.eye(count), (len(shapes), 1))

    @cached_property
    def moved(self) -> MovedCopies:
        """The responses in all copies."""
        return MovedCopies(*self.waves)

    def projected(
        self, pieces: Pieces, weights: np.ndarray, rows: Sequence[Waves]
    ) -> tuple[list[np.ndarray], np.ndarray]:
        """Weighted pieces between each of some rows (coordinates, a) and the responses, and between these (a, a)."""
        dofs, forces = self.moved.forces(pieces, weights)
        columns, units = self.waves
        return [each.work(dofs, forces) for each in rows], units.T @ columns.work(dofs, forces)


@dataclass(frozen=True, eq=False)
class Statics:
    """All attachments together, on the motions L that carry springs or masses.

    Parameters
    ----------
    to_units : responses to unit loads on the motions.
    stiffness, mass : (a, a) of the attachments between the motions.
    """

    to_units: StaticResponses
    stiffness: np.ndarray
    mass: np.ndarray

    def __len__(self) -> int:
        return len(self.stiffness)

    @property
    def answers(self) -> Answers:
        """To the unit loads."""
        return self.to_units.answers

    @property
    def loads(self) -> tuple[Loads, ...]:
        """Per problem: family → (s, a) unit loads on the coordinates that move the surface."""
        return self.to_units.loads

    @property
    def responses(self) -> tuple[Loads, ...]:
        """Per problem: family → (m, a) coordinates of Y."""
        return self.to_units.responses

    @property
    def waves(self) -> tuple[Waves, np.ndarray]:
        """The responses as columns of waves, and the coordinates (columns, a) of each response."""
        return self.to_units.waves


def statics(basis: SymmetricBasis, attachments: Sequence[Attachment]) -> Statics:
    """Static responses to the attachments' loads; those at the same points as lately are not made again."""
    stiffness = block_diag(*[a.stiffness for a in attachments]) if attachments else np.zeros((0, 0))
    mass = block_diag(*[a.mass for a in attachments]) if attachments else np.zeros((0, 0))
    used = _carrying(stiffness, mass)
    if used is None:
        to_units = basis.statics.once(
            tuple(a.place for a in attachments),
            lambda: _responses(basis, _loads(basis, attachments, np.eye(len(stiffness)))),
        )
        return Statics(to_units, stiffness, mass)
    loads = _loads(basis, attachments, used)
    return Statics(_responses(basis, loads), used.T @ stiffness @ used, used.T @ mass @ used)


def _responses(basis: SymmetricBasis, loaded: np.ndarray) -> StaticResponses:
    """To unit loads (problems, s, 2, a)."""
    return StaticResponses(basis.problems, basis.mesh.slots, loaded, _answers(basis, loaded))


def _answers(basis: SymmetricBasis, loaded: np.ndarray) -> Answers:
    if loaded.shape[-1] == 0:  # the surface's responses would be solved for nothing
        size, none = len(basis.values), np.zeros((0, 0))
        probes = np.zeros((len(basis.probes), 0))
        return Answers(np.zeros((0, size)), np.zeros((size, 0)), (probes, probes), none, none)
    return basis.surface.answers(loaded)


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
    """Displacements (S, motions) of an attachment's motions by the loaded coordinates of all problems, complex.

    Those of the latest places are kept: a support's springs stay where they are when a lump moves.
    """
    return basis.motions.once(a.place, lambda: basis.surface.motion(a))


def _loads(basis: SymmetricBasis, attachments: Sequence[Attachment], used: np.ndarray) -> np.ndarray:
    """Unit loads (problems, s, 2, a) on combinations of the motions."""
    if not attachments:
        return np.zeros((len(basis.problems), 0, 2, 0))
    return basis.surface.loads(np.hstack([_motion(basis, a) for a in attachments]) @ used)
