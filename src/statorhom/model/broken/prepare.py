"""A small basis for many evaluations of one kind of change: at any pitch, and at strengths like those of its training.

Enrichment finds what a change needs but brings much that it does not. The converged modes say what is needed: their
parts in every problem, cosine and sine, span the same space at whatever pitch the change sits.

Evaluate in it with `solve_broken(basis, changes, tolerance=None)`: every result still carries its error estimates.
Modes above the band are not trained: let the band end somewhat higher than the highest mode that matters.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from statorhom.model.broken.basis import SymmetricBasis
from statorhom.model.broken.change import Change
from statorhom.model.broken.enrich import extended
from statorhom.model.broken.problem_basis import ProblemBasis
from statorhom.model.broken.solve import TOLERANCE, BrokenModes, solve_broken

# Parts of the tolerance: what the trainings are solved to, and what the small basis keeps, so that places between
# them meet it.
SPARE, KEPT = 0.5, 0.8
# Directions that would lower the trained frequencies by less than this part of the tolerance are left out first,
# then those of half of it, until the trainings are met.
FIRST = 0.3
TRIALS = 8


def prepared(
    basis: SymmetricBasis, trainings: Sequence[Sequence[Change]], tolerance: float = TOLERANCE
) -> SymmetricBasis:
    """The basis for changes like those of the trainings.

    Parameters
    ----------
    basis : of the symmetric stator.
    trainings : each what `solve_broken` takes: a few places within half a slot pitch, a few strengths.
    tolerance : that is to be met.

    Raises
    ------
    SolverError
        If a training cannot be solved.
    """
    aim = SPARE * tolerance
    for changes in trainings:
        basis = solve_broken(basis, changes, aim).basis
    solved = [solve_broken(basis, changes, tolerance=None) for changes in trainings]
    for trial in range(TRIALS):
        least = FIRST * tolerance / 2**trial
        problems = (_compressed(basis, i, p, solved, least) for i, p in enumerate(basis.problems))
        small = replace(basis, problems=tuple(problems), grams=type(basis.grams)())
        again = (solve_broken(small, changes, tolerance=None) for changes in trainings)
        if all(
            len(a) == len(b) and np.all(a.errors < KEPT * tolerance)
            for a, b in zip(again, solved, strict=True)
        ):
            return small
    return basis


def _compressed(
    basis: SymmetricBasis, number: int, problem: ProblemBasis, solved: Sequence[BrokenModes], least: float
) -> ProblemBasis:
    """A problem with the modes of the band and the trained modes' parts."""
    parts = [
        problem.vectors @ modes.coordinates[place] / np.sqrt(2 * modes.eigenvalues)
        for modes in solved
        for place in basis.places[number].values()
    ]
    count = int(np.count_nonzero(problem.values <= (2 * np.pi * basis.highest_hz) ** 2))
    return extended(problem.lowest(count), np.hstack(parts), least)
