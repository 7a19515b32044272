"""How all harmonic problems of a stator answer unit loads on its outer surface, stacked: one product serves them all.

A stator has dozens of problems of a few dozen loaded coordinates each. One by one, their products take longer to be
called than to be made; stacked, what a problem lacks to the largest is filled up with zeros.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import scipy.sparse as sp

from statorhom.model.broken.change import Attachment
from statorhom.model.broken.problem_basis import ProblemBasis

_MIRROR = np.array([1.0, -1.0, 1.0])


@dataclass(frozen=True, eq=False)
class Answers:
    """To unit loads on the `a` motions L of a place: static responses Y = (K + σM)⁻¹ Lᵀ beside the basis W.

    Parameters
    ----------
    rows : (a, coordinates) LW.
    products : (coordinates, a) WᵀMY.
    probed : (probes, a) each, ζᵀLᵀ and ζᵀMY of the probes.
    flexibility : (a, a) LY.
    inertia : (a, a) YᵀMY.
    """

    rows: np.ndarray
    products: np.ndarray
    probed: tuple[np.ndarray, np.ndarray]
    flexibility: np.ndarray
    inertia: np.ndarray

    @property
    def motion(self) -> np.ndarray:
        """(a, coordinates + a) motions by the basis and by the static responses."""
        return np.hstack([self.rows, self.flexibility])


@dataclass(frozen=True, eq=False)
class SurfaceAnswers:
    """Of all problems, padded with zeros.

    Parameters
    ----------
    trace : (S, 3 n) complex sparse: displacements of the half pitch by the loaded coordinates of all problems.
    order, slots : (S,) harmonics of these coordinates, and the number of slot pitches.
    places : (problems, s) where a problem's loaded coordinates stand among all; S where it has no more.
    families : (problems, 2) whether the problem has cosine, and sine shapes.
    matrices : (problems, answers, s) to a unit load on each coordinate: several parts below each other.
    starts : of flexibility, inertia, vectors, vectors' and probes' mass products, and probes; and the end.
    coordinates, probes : problem, number and family of every coordinate of the basis, and of the probes.
    """

    trace: sp.csr_array
    order: np.ndarray
    slots: int
    places: np.ndarray
    families: np.ndarray
    matrices: np.ndarray
    starts: tuple[int, ...]
    coordinates: tuple[np.ndarray, ...]
    probes: tuple[np.ndarray, ...]

    def motion(self, place: Attachment) -> np.ndarray:
        """Displacements (S, motions) of a place's motions by the loaded coordinates of all problems, complex."""
        points = place.points
        total = np.zeros((len(self.order), len(place.rows)), dtype=complex)
        for pitch, mirrored in sorted(set(zip(points.pitch.tolist(), points.mirrored.tolist(), strict=True))):
            here = (points.pitch == pitch) & (points.mirrored == mirrored)
            signs = np.outer(here, _MIRROR if mirrored else np.ones(3)).ravel()
            moved = self.trace @ (points.matrix.T @ (signs[:, None] * place.rows.T))
            turn = np.exp(2j * np.pi / self.slots * (self.order * pitch % self.slots))
            total += turn[:, None] * (np.conj(moved) if mirrored else moved)
        return total

    def loads(self, motion: np.ndarray) -> np.ndarray:
        """Unit loads (problems, s, 2, a) on motions (S, a).

        Their real part belongs to cosine, their imaginary part to sine shapes.
        """
        filled = np.vstack([motion, np.zeros((1, motion.shape[1]))])[self.places]
        both = np.stack([filled.real, filled.imag], axis=2)
        return np.asarray(both * self.families[:, None, :, None])

    def answers(self, loads: np.ndarray) -> Answers:
        """To loads (problems, s, 2, a)."""
        problems, size, _, count = loads.shape
        found = (self.matrices @ loads.reshape(problems, size, -1)).reshape(problems, -1, 2, count)
        flexibility, inertia, vectors, masses, probe_masses, probes = (
            found[:, start:end] for start, end in pairwise(self.starts)
        )
        return Answers(
            vectors[self.coordinates].T,
            masses[self.coordinates],
            (probes[self.probes], probe_masses[self.probes]),
            _between(loads, flexibility),
            _between(loads, inertia),
        )


def _between(loads: np.ndarray, answers: np.ndarray) -> np.ndarray:
    count = loads.shape[-1]
    total = loads.reshape(-1, count).T @ answers.reshape(-1, count)
    return np.asarray((total + total.T) / 2)


def surface_answers(problems: Sequence[ProblemBasis], slots: int) -> SurfaceAnswers:
    """Of the problems of a stator with so many slot pitches."""
    sectors = [p.sector for p in problems]
    counts = [len(s.loaded) for s in sectors]
    size, first = max(counts), np.r_[0, np.cumsum(counts)]
    places = np.full((len(problems), size), first[-1])
    for place, start, count in zip(places, first, counts, strict=False):
        place[:count] = start + np.arange(count)
    answers = [_answers(p) for p in problems]
    heights = [max(len(part) for part in parts) for parts in zip(*answers, strict=True)]
    starts = tuple(int(n) for n in np.r_[0, np.cumsum(heights)])
    matrices = np.zeros((len(problems), starts[-1], size))
    for matrix, parts in zip(matrices, answers, strict=True):
        for start, part in zip(starts, parts, strict=False):
            matrix[start : start + len(part), : part.shape[1]] = part
    families = np.array([[sine in s.families for sine in (False, True)] for s in sectors])
    return SurfaceAnswers(
        sp.csr_array(sp.vstack([s.surface_trace for s in sectors], format="csr")),
        np.repeat([s.space.order for s in sectors], counts),
        slots,
        places,
        families,
        matrices,
        starts,
        _numbers(families, [p.vectors.shape[1] for p in problems]),
        _numbers(families, [p.probes.shape[1] for p in problems]),
    )


def _answers(problem: ProblemBasis) -> tuple[np.ndarray, ...]:
    """One problem's answers (…, s) to unit loads on its coordinates, in the order of `SurfaceAnswers.starts`."""
    (vectors, probes), masses = problem.surface_parts, problem.surface_products()
    answers = problem.sector.answers
    return answers.flexibility, answers.inertia, vectors.T, *masses, probes.T


def _numbers(families: np.ndarray, counts: Sequence[int]) -> tuple[np.ndarray, ...]:
    """Problem, number in it and family of all columns: cosine shapes first, as in `SymmetricBasis.waves`."""
    rows = [
        (problem, number, family)
        for family in (0, 1)
        for problem, count in enumerate(counts)
        if families[problem, family]
        for number in range(count)
    ]
    found = np.array(rows, dtype=int).reshape(-1, 3)
    return found[:, 0], found[:, 1], found[:, 2]
