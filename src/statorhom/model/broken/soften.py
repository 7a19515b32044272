"""A basis made ready for pieces that lose stiffness.

The softest stator that is still symmetric has every piece at its least weight in all copies. It is nowhere stiffer
than the broken one: residuals measured with its stiffness bound the error, and its modes show what the symmetric
stator's cannot, such as a winding that is no longer held by the teeth.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import scipy.sparse as sp

from statorhom.model.broken.basis import ProblemBasis, SymmetricBasis, probes
from statorhom.model.broken.change import PieceChange
from statorhom.model.broken.enrich import extended
from statorhom.model.broken.pieces import Pieces
from statorhom.model.eigen import modes_below

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
            basis = _with(basis, change.stiffness, known, np.minimum(least, known))
    return basis


def _with(basis: SymmetricBasis, pieces: Pieces, known: np.ndarray, least: np.ndarray) -> SymmetricBasis:
    less = pieces.matrix(least - known)
    problems = tuple(_problem(basis, problem, less) for problem in basis.problems)
    others = tuple((p, w) for p, w in basis.softest if p is not pieces)
    return replace(basis, problems=problems, softest=(*others, (pieces, least)), grams=type(basis.grams)())


def _problem(basis: SymmetricBasis, problem: ProblemBasis, less: sp.csr_array) -> ProblemBasis:
    space, M = problem.sector.space, problem.sector.M
    soft = sp.csr_array(problem.soft.K + space.copies * space.project(less))
    values, vectors = modes_below(soft, M, REACH * basis.highest_hz, len(problem.values) + 2)
    vectors = vectors / np.sqrt(values + basis.shift)
    drawn = probes(soft, M, basis.shift, space.order)
    return replace(extended(problem, vectors, PART), soft=replace(problem.soft, K=soft), probes=drawn)
