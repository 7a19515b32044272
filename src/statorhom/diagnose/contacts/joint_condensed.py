"""Contacts that are lost over an arc, in a few vectors: what the modes of some windings and arcs have in common.

An arc couples all harmonics, and together their bases have some hundred vectors, whose modes take a tenth of a second.
Those of the band are nearly sums of some eighty beside windings that are alike, and of two hundred all over the prior:
enough to tell thousands of windings apart, not to say what is left to explain.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache, partial

import numpy as np
from scipy.linalg import solve_triangular

from statorhom.diagnose.bases.ring_basis import RingModes, RingProblem, material_slope
from statorhom.diagnose.bases.small_pairs import small_pairs
from statorhom.diagnose.contacts.arc_slopes import LateSlope, Slope
from statorhom.diagnose.contacts.joint_arc import REACH, ArcGroup, Family, Weakened, arc_change
from statorhom.diagnose.contacts.leading_directions import leading_directions, sketch
from statorhom.model.affine import Materials, hooke_coefficients
from statorhom.physics.action import Joint

LEAST = 1e-4  # of the largest direction, in energy's root: what is smaller is left out
RIGID = 1e-4  # λ below which a body is rigid, over that of the band's end


@dataclass(frozen=True, eq=False)
class Span:
    """What modes at some materials and arcs are summed up in, so that none of them has to be kept.

    Parameters
    ----------
    roots : per problem (k, k), lower triangles of the mean energy there.
    top : λ at the band's end.
    most : vectors of one family.
    """

    roots: tuple[np.ndarray, ...]
    top: float
    most: int

    @classmethod
    def of(
        cls, problems: Sequence[RingProblem], materials: Sequence[Materials], top: float, most: int
    ) -> Span:
        """Of the energies that the problems have with some materials."""
        return cls(tuple(np.linalg.cholesky(_mean_energy(p, materials, top)) for p in problems), top, most)

    def sketches(self, weakened: Weakened) -> list[np.ndarray]:
        """What modes of one axial parity add to each family's sketch (`leading_directions`)."""
        return [self._sketch(family) for family in weakened.families]

    def vectors(self, numbers: Sequence[int], total: np.ndarray) -> np.ndarray:
        """(Σk, v) directions of most energy, of unit energy each.

        Parameters
        ----------
        numbers : of a family's problems.
        total : sum of its sketches.
        """
        left, sizes = leading_directions(total, self.most)
        roots = [self.roots[n] for n in numbers]
        parts = np.split(left[:, sizes > LEAST * sizes[0]], np.cumsum([len(r) for r in roots])[:-1])
        return np.vstack([solve_triangular(r.T, part) for r, part in zip(roots, parts, strict=True)])

    def _sketch(self, family: Family) -> np.ndarray:
        # of unit energy, and rigid bodies, which have none, of unit motion
        rigid = np.where(family.values <= RIGID * self.top, self.top, 0.0)
        own = np.split(family.coordinates, list(family.starts.values())[1:])
        parts = zip(family.starts, own, strict=True)
        shapes = np.vstack([self.roots[n].T @ (family.even.vectors[n] @ x) for n, x in parts])
        return sketch(shapes / np.sqrt(np.maximum(family.values, 0.0) + rigid), self.most)


def _mean_energy(problem: RingProblem, materials: Sequence[Materials], top: float) -> np.ndarray:
    pairs = (problem.matrices(m) for m in materials)
    return np.asarray(sum(K + top * M for K, M in pairs) / len(materials))


@dataclass(frozen=True, eq=False)
class CondensedModes(Family):
    """Cosine or sine shapes as a sum of few vectors.

    Parameters
    ----------
    vectors : (v, m) of unit mass.
    family : whose vectors these are.
    """

    vectors: np.ndarray
    family: CondensedFamily

    def slope(self, number: int, materials: Materials) -> Slope:
        """As of all coordinates, but for what the few vectors leave out."""
        # of all modes it keeps this one
        own = self.vectors[:, number].copy(), float(self.values[number])
        return LateSlope(partial(self.family.slope, *own, materials))


@dataclass(frozen=True, eq=False)
class CondensedFamily:
    """The vectors of cosine or sine shapes.

    Parameters
    ----------
    problems : by number, whose coordinates these vectors are made of.
    vectors : (Σk, v) in them, one problem after the other.
    halves : (2, N, v²) contact of unit stiffness of the two half pitches that lie equally far from θ = 0, the nearest
        ones first; normal and tangential.
    highest : λ up to which modes are known.
    """

    problems: dict[int, RingProblem]
    vectors: np.ndarray
    halves: np.ndarray
    highest: float

    @property
    def regions(self) -> tuple[str, ...]:
        """Of the materials."""
        return tuple(next(iter(self.problems.values())).stiffness)

    @cached_property
    def _parts(self) -> tuple[np.ndarray, ...]:
        """The vectors (k, v) in every problem."""
        ends = np.cumsum([p.basis.shape[1] for p in self.problems.values()])
        return tuple(np.split(self.vectors, ends[:-1]))

    @cached_property
    def _intact(self) -> np.ndarray:
        """(2, v²) contact of all half pitches."""
        return np.asarray(self.halves.sum(axis=1))

    @cached_property
    def _stiffness(self) -> np.ndarray:
        """(9 regions, v²) K per unit Hooke entry."""
        own = list(zip(self.problems.values(), self._parts, strict=True))
        terms = ((r, q) for r in self.regions for q in range(9))
        return np.stack([sum((v.T @ p.stiffness[r][q] @ v).ravel() for p, v in own) for r, q in terms])

    @cached_property
    def _images(self) -> tuple[np.ndarray, ...]:
        """(regions, k v) what the masses of unit density make of the vectors, in every problem."""
        own = zip(self.problems.values(), self._parts, strict=True)
        return tuple(np.stack([(p.mass[r] @ v).ravel() for r in self.regions]) for p, v in own)

    @cached_property
    def _mass(self) -> np.ndarray:
        """(regions, v²) M per unit density."""
        rows = range(len(self.regions))
        own = list(zip(self._parts, self._images, strict=True))
        return np.stack([sum((v.T @ image[r].reshape(v.shape)).ravel() for v, image in own) for r in rows])

    def solved(
        self, even: RingModes, materials: Materials, joint: Joint, change: np.ndarray
    ) -> CondensedModes:
        """Modes at given materials and arc.

        Parameters
        ----------
        even : modes of the even contact there.
        change : (N,) of the contact of the half pitches, the nearest ones to θ = 0 first.

        Raises
        ------
        SolverError
            If a mass is not definite.
        """
        coefficients = np.concatenate([hooke_coefficients(materials[r].hooke) for r in self.regions])
        density = np.array([materials[r].density for r in self.regions])
        reach = len(np.trim_zeros(change, "b"))  # beyond that the contact is intact
        normal, tangential = (
            w + change[:reach] @ own[:reach] for w, own in zip(self._intact, self.halves, strict=True)
        )
        K = coefficients @ self._stiffness + joint.normal * normal + joint.tangential * tangential
        shape = (self.vectors.shape[1],) * 2
        values, x = small_pairs(K.reshape(shape), (density @ self._mass).reshape(shape))
        seen = int(np.searchsorted(values, self.highest))
        values, x = values[:seen], x[:, :seen]
        starts, first, rows = {}, 0, []
        for n, part, image in zip(self.problems, self._parts, self._images, strict=True):
            starts[n], first = first, first + even.vectors[n].shape[1]
            rows.append(even.vectors[n].T @ (density @ image).reshape(part.shape) @ x)
        return CondensedModes(even, starts, values, np.vstack(rows), x, self)

    def slope(self, vector: np.ndarray, value: float, materials: Materials) -> np.ndarray:
        """d ln f of a mode (v,) of λ = `value` by Hooke entries and density of all regions."""
        return material_slope(vector, value, (self._stiffness, self._mass), self.regions, materials)


@dataclass(frozen=True, eq=False)
class CondensedGroup:
    """The families of one axial parity.

    Parameters
    ----------
    slots : N.
    families : of cosine and of sine shapes.
    """

    slots: int
    families: tuple[CondensedFamily, ...]

    def weakened(self, even: RingModes, joint: Joint, materials: Materials) -> Weakened:
        """Modes with a weaker arc around θ = 0."""
        change = arc_change(joint, self.slots)[_nearest_first(self.slots)[0]]
        return Weakened(tuple(f.solved(even, materials, joint, change) for f in self.families))


def condensed(
    group: ArcGroup, problems: Sequence[RingProblem], span: Span, sketches: Sequence[np.ndarray]
) -> CondensedGroup:
    """A group in the vectors that its modes at some materials and arcs span.

    Parameters
    ----------
    group, problems : the problems that an arc couples, of all problems.
    span, sketches : of these modes, of cosine and of sine shapes.
    """
    numbers = group.cosine, group.sine
    vectors = [span.vectors(own, total) for own, total in zip(numbers, sketches, strict=True)]
    pieces = [group.contact.halves(piece, vectors) for piece in range(2)]
    here, there = _nearest_first(group.slots)
    families = tuple(
        CondensedFamily(
            {n: problems[n] for n in own},
            V,
            np.array([h[here] + h[there] for h in halves]),
            REACH * span.top,
        )
        for own, V, *halves in zip(numbers, vectors, *pieces, strict=True)
    )
    return CondensedGroup(group.slots, families)


@lru_cache(maxsize=8)
def _nearest_first(slots: int) -> tuple[np.ndarray, np.ndarray]:
    """Numbers (N,) of the half pitches by how far from θ = 0 they lie, and of their mirror images (`arc_change`)."""
    pitch = np.arange(slots)
    order = np.argsort(np.minimum(pitch + 0.25, slots - pitch - 0.25))
    return 2 * order, 2 * (-order % slots) + 1
