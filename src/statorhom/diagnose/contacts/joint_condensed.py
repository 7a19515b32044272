"""Contacts that are lost over an arc, in a few vectors: what the modes of some windings and arcs have in common.

An arc couples all harmonics, and together their bases have some hundred vectors, whose modes take a tenth of a second.
Those of the band are nearly sums of some eighty beside windings that are alike, and of two hundred all over the prior:
enough to tell thousands of windings apart, not to say what is left to explain.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.linalg import block_diag, solve_triangular

from statorhom.diagnose.bases.ring_basis import RingModes, RingProblem, material_slope
from statorhom.diagnose.bases.small_pairs import small_pairs
from statorhom.diagnose.contacts.joint_arc import ArcGroup, Family, Weakened, arc_change
from statorhom.model.affine import Materials, hooke_coefficients
from statorhom.physics.action import Joint

LEAST = 1e-4  # of the largest direction, in energy's root: what is smaller is left out
RIGID = 1e-4  # λ below which a body is rigid, over that of the band's end


@dataclass(frozen=True, eq=False)
class Sample:
    """Modes of one axial parity that were solved.

    Parameters
    ----------
    materials : of all regions.
    weakened : the modes.
    """

    materials: Materials
    weakened: Weakened


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

    def slope(self, number: int, materials: Materials) -> np.ndarray:
        """As of all coordinates, but for what the few vectors leave out."""
        return self.family.slope(self.vectors[:, number], float(self.values[number]), materials)


@dataclass(frozen=True, eq=False)
class CondensedFamily:
    """The vectors of cosine or sine shapes.

    Parameters
    ----------
    problems : by number, whose coordinates these vectors are made of.
    vectors : (Σk, v) in them, one problem after the other.
    halves : (2, 2 N, v²) contact of unit stiffness of every half pitch, normal and tangential.
    """

    problems: dict[int, RingProblem]
    vectors: np.ndarray
    halves: np.ndarray

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
        change : (2 N,) of every half pitch's contact (`arc_change`).

        Raises
        ------
        SolverError
            If a mass is not definite.
        """
        coefficients = np.concatenate([hooke_coefficients(materials[r].hooke) for r in self.regions])
        density = np.array([materials[r].density for r in self.regions])
        contact = np.outer((joint.normal, joint.tangential), 1.0 + change)
        K = coefficients @ self._stiffness + np.tensordot(contact, self.halves)
        shape = (self.vectors.shape[1],) * 2
        values, x = small_pairs(K.reshape(shape), (density @ self._mass).reshape(shape))
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
        change = arc_change(joint, self.slots)
        return Weakened(tuple(f.solved(even, materials, joint, change) for f in self.families))


def condensed(
    group: ArcGroup, problems: Sequence[RingProblem], samples: Sequence[Sample], top: float, most: int
) -> CondensedGroup:
    """A group in the vectors that its modes at some materials and arcs span.

    Parameters
    ----------
    group, problems : the problems that an arc couples, of all problems.
    samples : modes of the group.
    top : λ at the band's end.
    most : vectors of one family.
    """
    vectors, own = [], []
    for number, numbers in enumerate((group.cosine, group.sine)):
        own.append({n: problems[n] for n in numbers})
        vectors.append(_vectors(own[-1], number, samples, top, most))
    pieces = [group.contact.halves(piece, vectors) for piece in range(2)]
    families = zip(own, vectors, *pieces, strict=True)
    return CondensedGroup(group.slots, tuple(CondensedFamily(p, V, np.array(h)) for p, V, *h in families))


def _vectors(
    problems: dict[int, RingProblem], number: int, samples: Sequence[Sample], top: float, most: int
) -> np.ndarray:
    """(Σk, v) directions in which most of the samples' energy lies, of unit energy in their mean."""
    found, energy = [], np.zeros(())
    for sample in samples:
        family = sample.weakened.families[number]
        shapes = block_diag(*[family.even.vectors[n] for n in problems]) @ family.coordinates
        # of unit energy, and rigid bodies, which have none, of unit motion
        rigid = np.where(family.values <= RIGID * top, top, 0.0)
        found.append(shapes / np.sqrt(np.maximum(family.values, 0.0) + rigid))
        pairs = [p.matrices(sample.materials) for p in problems.values()]
        energy = energy + block_diag(*[K + top * M for K, M in pairs]) / len(samples)
    root = np.linalg.cholesky(energy)
    left, sizes, _ = np.linalg.svd(root.T @ np.hstack(found), full_matrices=False)
    count = min(most, int(np.count_nonzero(sizes > LEAST * sizes[0])))
    return np.asarray(solve_triangular(root.T, left[:, :count]))
