"""The part of a symmetric basis that moves the outer surface.

A soft winding has hundreds of modes of its own in the band. What breaks the symmetry at the surface or in the back of
the core hardly moves them, and they hardly move it: without them the eigenproblem is a fraction of the size.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable
from dataclasses import replace

import numpy as np

from statorhom.model.broken.basis import SymmetricBasis
from statorhom.model.broken.grams import GramCache
from statorhom.model.broken.problem_basis import ProblemBasis
from statorhom.model.harmonic import Harmonic

# Of the largest surface motion of a mode. Clamped modes of a wound stator with 1 300 modes in the band, of which 720
# are left out by it, change by 5e-5 at most.
LEAST = 3e-3


def visible(
    basis: SymmetricBasis, kept: Iterable[tuple[Harmonic, float]] = (), least: float = LEAST
) -> SymmetricBasis:
    """The basis without the modes that hardly move the outer surface.

    Parameters
    ----------
    basis : of the symmetric stator.
    kept : problems and frequencies (Hz) of modes that stay whatever they move.
    least : mean motion of the surface below which a mode is left out, over that of the mode that moves it most.
    """
    motions = [_surface_motion(p) for p in basis.problems]
    limit = least * max((m.max(initial=0.0) for m in motions), default=0.0)
    stay = _values_by_problem(kept)
    problems = []
    for problem, motion in zip(basis.problems, motions, strict=True):
        keep = motion >= limit
        for value in stay.get(problem.sector.space.kind, ()) if len(keep) else ():
            keep[np.argmin(np.abs(problem.values - value))] = True
        problems.append(problem.chosen(keep))
    return replace(basis, problems=tuple(problems), grams=GramCache())


def _surface_motion(problem: ProblemBasis) -> np.ndarray:
    """(w,) root mean square motion of the outer surface by every vector."""
    moved = problem.sector.moved @ problem.surface_parts[0]
    return np.asarray(np.sqrt(np.mean(np.abs(moved) ** 2, axis=0)))


def _values_by_problem(named: Iterable[tuple[Harmonic, float]]) -> dict[tuple[Hashable, ...], list[float]]:
    """Eigenvalues (rad²/s²) of modes, by their problem."""
    found: dict[tuple[Hashable, ...], list[float]] = {}
    for space, frequency in named:
        found.setdefault(space.kind, []).append((2 * np.pi * frequency) ** 2)
    return found
