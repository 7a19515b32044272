"""A basis made ready for pieces that lose stiffness.

The softest stator that is still symmetric has every piece at its least weight in all copies. It is nowhere stiffer
than the broken one: residuals measured with its stiffness bound the error, and its modes show what the symmetric
stator's cannot, such as a winding that is no longer held by the teeth.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from statorhom.errors import SolverError
from statorhom.model.broken.basis import SymmetricBasis
from statorhom.model.broken.change import PieceChange
from statorhom.model.broken.enrich import extended
from statorhom.model.broken.pieces import Pieces
from statorhom.model.broken.problem_basis import ProblemBasis, solved_problems
from statorhom.model.cyclic.problem import CyclicProblem, Shifted

SLIGHT = 0.3  # a piece that keeps more than 1 - this of the stiffness it has in the basis needs no new probes
REACH = 1.5  # the softest stator's modes that are added reach this much higher than the band
PART = 1e-6  # of the energy scale of the band: new directions with less are left out


def softened(basis: SymmetricBasis, changes: Sequence[PieceChange]) -> SymmetricBasis:
    """The basis with the modes and the probes of the softest symmetric stator, where the changes are softer."""
    for change in changes:
        if change.stiffness is None:
            continue
        least = np.minimum(change.weights.min(axis=1), 0.0)
        known = next((w for p, w in basis.softest if p is change.stiffness), np.zeros(len(least)))
        if np.any(least < known - SLIGHT * (1 + known)):
            try:
                basis = _with(basis, change.stiffness, known, np.minimum(least, known))
            except SolverError:
                # nothing may be left where all changes are at their least at once, which they are in no copy
                continue
    return basis


def _with(basis: SymmetricBasis, pieces: Pieces, known: np.ndarray, least: np.ndarray) -> SymmetricBasis:
    less = pieces.matrix(least - known)
    parts = {p.soft.space.axial: p.soft.problem.shifted for p in basis.problems}
    softer = {axial: Shifted(own.pitch.stiffened(less), own.shift) for axial, own in parts.items()}
    sectors = [
        replace(p.soft, problem=CyclicProblem(p.soft.space, softer[p.soft.space.axial]))
        for p in basis.problems
    ]
    solved = solved_problems(sectors, REACH * basis.highest_hz)
    problems = tuple(_joined(basis, *pair) for pair in zip(basis.problems, solved, strict=True))
    others = tuple((p, w) for p, w in basis.softest if p is not pieces)
    return replace(basis, problems=problems, softest=(*others, (pieces, least)), grams=type(basis.grams)())


def _joined(basis: SymmetricBasis, problem: ProblemBasis, soft: ProblemBasis) -> ProblemBasis:
    """A problem with the modes and the probes of its softest form."""
    vectors = soft.vectors / np.sqrt(np.maximum(soft.values, 0.0) + basis.shift)
    return replace(extended(problem, vectors, PART), soft=soft.sector, probes=soft.probes)
