"""Modes of one harmonic problem of the symmetric stator, and probes that tell the error of what is solved in them.

A few random probes ζ with covariance (K' + σM)⁻¹ go with the modes: for any residual r the mean of (ζᵀr)² is
rᵀ(K' + σM)⁻¹r, so that the error of a solution is known without a solve. K' is the stiffness of the symmetric stator
that is nowhere stiffer than any broken one (`statorhom.model.broken.soften`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from statorhom.model.blas_threads import one_blas_thread
from statorhom.model.broken.sector import Sector
from statorhom.model.cyclic.modes import modes_of
from statorhom.model.cyclic.problem import CyclicProblem

PROBES = 8  # per problem


@dataclass(frozen=True, eq=False)
class ProblemBasis:
    """Basis of one harmonic problem.

    Parameters
    ----------
    sector : the problem.
    soft : the same problem of the softest symmetric stator.
    values : (w,) Ritz values of the vectors (rad²/s²).
    vectors : (m, w) coordinates of unit modal mass.
    elastic, inertial : (m, w) K and M times the vectors.
    probes : (m, t) random vectors with covariance (K' + σM)⁻¹.
    """

    sector: Sector
    soft: Sector
    values: np.ndarray
    vectors: np.ndarray
    elastic: np.ndarray
    inertial: np.ndarray
    probes: np.ndarray

    def __post_init__(self) -> None:
        for array in (self.values, self.vectors, self.elastic, self.inertial, self.probes):
            array.setflags(write=False)

    def lowest(self, count: int) -> ProblemBasis:
        """The first vectors only."""
        return self.chosen(slice(count))

    def chosen(self, which: slice | np.ndarray) -> ProblemBasis:
        """Some of the vectors, by a slice or by a mask."""
        arrays = {
            name: getattr(self, name)[..., which] for name in ("values", "vectors", "elastic", "inertial")
        }
        return replace(self, **arrays)

    def surface_products(self) -> tuple[np.ndarray, np.ndarray]:
        """Mass products (w, s) and (t, s) of vectors and probes with the surface's static responses."""
        answers = self.sector.answers
        return answers.against(self.inertial), answers.against(self.sector.M @ self.probes)

    @cached_property
    def surface_parts(self) -> tuple[np.ndarray, np.ndarray]:
        """Loaded coordinates (s, w) and (s, t) of vectors and probes."""
        return self.vectors[self.sector.loaded], self.probes[self.sector.loaded]


def solved_problems(
    sectors: Sequence[Sector], highest_hz: float, *, certified: bool = True, jobs: int = 1
) -> tuple[ProblemBasis, ...]:
    """All modes of problems up to a frequency, and their probes where they are to be certified."""
    pitches = {id(s.problem.shifted): s.problem.shifted.pitch for s in sectors}
    pairs = modes_of(tuple(pitches.values()), [s.space for s in sectors], highest_hz, jobs=jobs)
    found = []
    with one_blas_thread():
        for sector, (values, vectors) in zip(sectors, pairs, strict=True):
            vectors = vectors / np.sqrt(sector.space.copies)
            images = sector.K @ vectors, sector.M @ vectors
            drawn = probes(sector.problem) if certified else np.empty((sector.space.size, 0))
            found.append(ProblemBasis(sector, sector, values, vectors, *images, drawn))
    return tuple(found)


def probes(problem: CyclicProblem) -> np.ndarray:
    """Random vectors (m, t) with covariance (K + σM)⁻¹."""
    weights = np.random.default_rng(problem.space.order).standard_normal((problem.space.size, PROBES))
    return problem.sampled(weights)
