"""Static responses of the symmetric stator to unit loads on the motions that springs and masses act on.

Y = (K + σM)⁻¹ Lᵀ over all harmonics: one solve per problem, motion and family. With them in the basis a spring's or a
lump's own local field is exact, and modes above the cut count only by their inertia.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.sparse as sp
from scipy.linalg import block_diag

from statorhom.model.broken.basis import ProblemBasis, SymmetricBasis
from statorhom.model.broken.change import Attachment
from statorhom.model.broken.waves import Waves

_MIRROR = np.array([1.0, -1.0, 1.0])
DEPENDENT = 1e-12  # part of the largest eigenvalue below which a motion carries neither spring nor mass


@dataclass(frozen=True)
class Statics:
    """All attachments together, on the motions L that carry springs or masses.

    Parameters
    ----------
    basis : of the symmetric stator.
    stiffness, mass : (a, a) of the attachments between the motions.
    loads : per problem: family → (m, a) coordinates of unit loads Lᵀ.
    responses : per problem: family → (m, a) coordinates of Y.
    """

    basis: SymmetricBasis
    stiffness: np.ndarray
    mass: np.ndarray
    loads: tuple[Mapping[bool, np.ndarray], ...]
    responses: tuple[Mapping[bool, np.ndarray], ...]

    def __len__(self) -> int:
        return len(self.stiffness)

    @cached_property
    def rows(self) -> np.ndarray:
        """LW of the basis, (a, coordinates)."""
        return self._against("vectors", self.loads, mass=False).T

    @cached_property
    def products(self) -> np.ndarray:
        """WᵀMY, (coordinates, a)."""
        return self._against("vectors", self.responses, mass=True)

    @cached_property
    def probed(self) -> tuple[np.ndarray, np.ndarray]:
        """ζᵀLᵀ and ζᵀMY of the probes, (probes, a) each."""
        return self._against("probes", self.loads, mass=False), self._against("probes", self.responses, mass=True)

    @cached_property
    def flexibility(self) -> np.ndarray:
        """LY, (a, a)."""
        return self._within(self.loads, None)

    @cached_property
    def inertia(self) -> np.ndarray:
        """YᵀMY, (a, a)."""
        return self._within(self.responses, "M")

    @cached_property
    def waves(self) -> tuple[Waves, np.ndarray]:
        """The responses as columns of waves, and the coordinates (columns, a) of each response."""
        shapes, order, chosen, units = [], [], {False: [0][:0], True: [0][:0]}, {False: [], True: []}
        count = 0
        for problem, parts in zip(self.basis.problems, self.responses, strict=True):
            for sine, part in parts.items():
                shapes.append(problem.space.expand(part))
                order += [problem.space.order] * len(self)
                chosen[sine] = [*chosen[sine], *range(count, count + len(self))]
                units[sine].append(np.eye(len(self)))
                count += len(self)
        slots = self.basis.mesh.slots
        columns = Waves(
            np.hstack(shapes), np.array(order), np.array(chosen[False], int), np.array(chosen[True], int), slots
        )
        return columns, np.vstack([*units[False], *units[True]])

    def _against(
        self, name: str, parts: Sequence[Mapping[bool, np.ndarray]], *, mass: bool
    ) -> np.ndarray:
        blocks: dict[bool, list[np.ndarray]] = {False: [], True: []}
        for problem, part in zip(self.basis.problems, parts, strict=True):
            left = getattr(problem, name)
            left = problem.M @ left if mass else left
            for sine, columns in part.items():
                blocks[sine].append(left.T @ columns)
        return np.vstack([*blocks[False], *blocks[True]])

    def _within(self, parts: Sequence[Mapping[bool, np.ndarray]], name: str | None) -> np.ndarray:
        total = np.zeros((len(self), len(self)))
        for problem, left, right in zip(self.basis.problems, parts, self.responses, strict=True):
            for sine, columns in left.items():
                other = right[sine] if name is None else getattr(problem, name) @ right[sine]
                total += columns.T @ other
        return (total + total.T) / 2


def statics(basis: SymmetricBasis, attachments: Sequence[Attachment]) -> Statics:
    """Static responses to the attachments' loads."""
    stiffness = block_diag(*[a.stiffness for a in attachments]) if attachments else np.zeros((0, 0))
    mass = block_diag(*[a.mass for a in attachments]) if attachments else np.zeros((0, 0))
    used = _carrying(stiffness, mass)
    loads, responses = [], []
    for problem, solve in zip(basis.problems, basis.solvers, strict=True):
        rows = _rows(problem, attachments)
        unit = {sine: used.T @ (rows.imag if sine else rows.real) for sine in problem.families}
        loads.append({sine: np.ascontiguousarray(load.T) for sine, load in unit.items()})
        responses.append({sine: solve(load) if load.size else load for sine, load in loads[-1].items()})
    return Statics(basis, used.T @ stiffness @ used, used.T @ mass @ used, tuple(loads), tuple(responses))


def _carrying(stiffness: np.ndarray, mass: np.ndarray) -> np.ndarray:
    """Orthonormal combinations (b, a) of the motions that carry a spring or a mass."""
    parts = [np.abs(m).max(initial=0.0) for m in (stiffness, mass)]
    total = sum((m / p for m, p in zip((stiffness, mass), parts, strict=True) if p > 0.0), np.zeros_like(mass))
    values, vectors = np.linalg.eigh(total)
    return np.asarray(vectors[:, values > DEPENDENT * values.max(initial=0.0)])


def _rows(problem: ProblemBasis, attachments: Sequence[Attachment]) -> np.ndarray:
    """Complex rows (b, m): their real part is the motion under cosine, their imaginary part under sine shapes."""
    space = problem.space
    found = [np.zeros((0, space.size), dtype=complex)]
    for a in attachments:
        local = (a.points.matrix @ space.real).toarray() + 1j * (a.points.matrix @ space.imaginary).toarray()
        mirrored = np.repeat(a.points.mirrored, 3)[:, None]
        sign = np.tile(_MIRROR, len(a.points))[:, None]
        turn = np.exp(2j * np.pi * space.order / space.slots * np.repeat(a.points.pitch, 3))[:, None]
        found.append(a.rows @ (np.where(mirrored, np.conj(local) * sign, local) * turn))
    return np.vstack(found)
