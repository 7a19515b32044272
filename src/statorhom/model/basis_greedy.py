"""Build the basis of a cell: greedy snapshots at the largest certified error, then no more than they need.

A snapshot is an eigenproblem of the full model. Where that is dear, as of blocks, and materials differ in few ways,
only the softest one is solved, which has the most modes in the band; at all others the basis grows by corrections A⁻¹r
of the residuals r of its own Ritz vectors (E. R. Davidson, J. Comput. Phys. 17 (1975) 87), for which the factorization
of the norm serves.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from statorhom.model.back_ends.sturdy import sturdy
from statorhom.model.basis_compression import compression
from statorhom.model.common_snapshots import Snapshots
from statorhom.model.eigen import factorize, modes_below
from statorhom.model.harmonic_terms import HarmonicTerms
from statorhom.model.local_basis import BEYOND, LocalBasis, RoomBasis, norm_shift
from statorhom.model.material_cells import stiffness_ratio
from statorhom.model.material_span import MaterialPoint
from statorhom.model.reduced_space import ReducedSpace, largest_deviation, symmetric
from statorhom.model.residual_norm import residual_norm
from statorhom.model.space import MIRROR

SOLVED = 1e-6  # relative tolerance of a snapshot's eigenvalues: it shows a direction, nobody reads its digits
DROP = 0.2  # of the tolerance: the energy below which a new direction may be left out
BUILT = 0.6  # of the tolerance: what the greedy basis meets before it is compressed to the tolerance
AT_ONCE = 16  # certificates that are computed side by side
# of the error before: where several corrections in a row leave more of it, the full model is asked; one may, for a
# certificate is large where a new Ritz value comes near another
SLOW, PATIENCE = 0.5, 3
CORRECTIONS = 4  # as many rounds of corrections as snapshots are allowed
# directions in which materials move up to which corrections are used: a box of many needs more vectors than are cheap
FEW, MOVES = 4, 1e-2
RESOLVED = 1e-5  # of the tolerance: the part of the energy that residuals need not resolve; gaps magnify it


def local_basis(
    terms: HarmonicTerms,
    training: Sequence[MaterialPoint],
    rooms: Sequence[Sequence[int]],
    highest_hz: float,
    tolerance: float,
    most: int,
    known: Snapshots,
) -> LocalBasis:
    """Build the basis of a cell.

    Parameters
    ----------
    terms : of the harmonic.
    training : materials of the cell; the norm of the residuals is that of the first.
    rooms : numbers of each room's training materials.
    highest_hz : upper end of the band in which modes are to be exact.
    tolerance : certified relative frequency error to stay below.
    most : largest number of snapshots.
    known : modes at some of the training materials.
    """
    builder = _Builder(terms, training, highest_hz, tolerance, known)
    if terms.parity == MIRROR and _directions(builder.weights) <= FEW:
        _correct(builder, CORRECTIONS * most)
    else:
        _collect(builder, most)
    return LocalBasis(builder.basis, tuple(builder.room(list(members)) for members in rooms))


def _directions(weights: np.ndarray) -> int:
    """In how many independent directions weights (n, t) lie that matter, each in units of its largest."""
    scale = np.abs(weights).max(axis=0)
    singular = np.linalg.svd(weights[:, scale > 0] / scale[scale > 0], compute_uv=False)
    return int(np.count_nonzero(singular > MOVES * singular[0]))


def _collect(builder: _Builder, most: int) -> None:
    """Snapshots of the reference and where the error is largest."""
    builder.add_snapshot(0)
    errors = np.full(len(builder.training), np.inf)
    for _ in range(most - 1):
        worst = builder.known_first(errors, builder.worst(errors))
        if errors[worst] <= BUILT * builder.tolerance:
            # a certificate does not see a mode that the basis misses altogether; the full model does
            worst = int(np.argmin(builder.ratios))
            if builder.true_error(worst) <= builder.tolerance:
                break
        if not builder.add_snapshot(worst):
            break


def _correct(builder: _Builder, most: int) -> None:
    """A snapshot of the softest material, which misses no mode, and corrections where the error is largest."""
    builder.add_snapshot(int(np.argmin(builder.ratios)))
    errors = np.full(len(builder.training), np.inf)
    slow = 0
    for _ in range(most):
        worst = builder.worst(errors)
        before = errors[worst]
        if before <= BUILT * builder.tolerance:
            break
        grown = builder.add_corrections(worst)
        slow = slow + 1 if builder.certified_errors(np.array([worst]))[0] > SLOW * before else 0
        if slow >= PATIENCE or not grown:
            grown, slow = builder.add_snapshot(worst) or grown, 0
        if not grown:
            break


class _Builder:
    """The growing basis in the full space and in its own."""

    def __init__(
        self,
        terms: HarmonicTerms,
        training: Sequence[MaterialPoint],
        highest_hz: float,
        tolerance: float,
        known: Snapshots,
    ) -> None:
        self.terms, self.training = terms, training
        self.highest_hz, self.tolerance = highest_hz, tolerance
        self.weights = np.array([np.r_[terms.span.weights(p), p.density] for p in training])
        self.ratios = np.array([stiffness_ratio(p, training[0]) for p in training])
        K, self.metric = terms.matrices(training[0])
        top, shift = float((2 * np.pi * highest_hz) ** 2), norm_shift(highest_hz)
        self.operator = K + shift * self.metric
        # a block's matrices are larger and fuller than a half pitch's
        self.factorize = sturdy if terms.parity == MIRROR else factorize
        self.solve = self.factorize(self.operator)
        size, count = self.operator.shape[0], len(self.weights[0])
        self.basis = np.empty((size, 0))
        self.images = np.empty((count, size, 0))
        self.space = ReducedSpace(
            np.empty((count, 0, 0)), np.empty((count, 0, count, 0)), terms.span.size, top, shift
        )
        self.expected = 8
        self.known = known
        self.solved: dict[int, tuple[np.ndarray, np.ndarray]] = {}  # the last full solution

    def true_error(self, number: int) -> float:
        """Relative frequency error at a training material, infinite where a mode is missing."""
        exact, found = self._full_modes(number)[0], self.space.pairs(self.weights[number])[0]
        return largest_deviation(exact, found, self.space.top)

    def add_snapshot(self, number: int) -> bool:
        """Take in a material's modes; False where they bring nothing new."""
        vectors = self._full_modes(number)[1]
        energies = np.einsum("ij,ij->j", vectors, self.operator @ vectors)
        return self._add(vectors / np.sqrt(energies))

    def add_corrections(self, number: int) -> bool:
        """Take in A⁻¹r of the Ritz vectors in the band and of the next one; False where these bring nothing new.

        Their energies in units of what the Ritz vectors have at least in the material itself bound the relative
        errors of the eigenvalues.
        """
        weights = self.weights[number]
        values, vectors = self.space.pairs(weights)
        used = int((values <= self.space.top).sum()) + BEYOND
        values, vectors = values[:used], vectors[:, :used]
        parts = weights[:, None, None] * vectors
        parts[self.space.directions :] *= -values
        residuals = np.tensordot(self.images, parts, axes=((0, 2), (0, 1)))
        least = self.ratios[number] * (values + self.space.shift)
        return self._add(self.solve(residuals) / np.sqrt(least))

    def _add(self, vectors: np.ndarray) -> bool:
        """Take in what vectors (m, j) add to the basis."""
        new = self._new_directions(vectors)
        if new.shape[1] == 0:
            return False
        images = self.terms.images(new)
        count, size, columns = images.shape
        dual = self.solve(np.ascontiguousarray(images.transpose(1, 0, 2).reshape(size, -1)))
        self.basis = np.hstack([self.basis, new])
        self.images = np.concatenate([self.images, images], axis=2)
        self._extend(dual.reshape(size, count, columns))
        return True

    def _extend(self, dual: np.ndarray) -> None:
        """Matrices of the basis after its last columns came; `dual` (m, t, columns): A⁻¹ times their images."""
        size, count, columns = dual.shape
        old, k = self.space.size, self.basis.shape[1]
        gram = np.empty((count, k, count, k))
        gram[:, :old, :, :old] = self.space.gram
        flat = self.images.transpose(0, 2, 1).reshape(-1, size)
        gram[..., old:] = (flat @ dual.reshape(size, -1)).reshape(count, k, count, columns)
        gram[:, old:, :, :old] = gram[:, :old, :, old:].transpose(2, 3, 0, 1)
        self.space = replace(self.space, projected=symmetric(self.basis.T @ self.images), gram=gram)

    def _full_modes(self, number: int) -> tuple[np.ndarray, np.ndarray]:
        if number in self.known:
            return self.known[number]
        if number not in self.solved:
            K, M = self.terms.matrices(self.training[number])
            # the reference's own shifted matrix is factorized already
            back_end = self.factorize if number else lambda _: self.solve
            wanted: dict[str, Any] = {"tolerance": SOLVED, "beyond": BEYOND, "back_end": back_end}
            found = modes_below(K, M, self.highest_hz, self.expected, **wanted)
            self.expected = len(found[0]) + 2
            self.solved = {number: found}
        return self.solved[number]

    def _new_directions(self, new: np.ndarray) -> np.ndarray:
        """What vectors add to the basis, of unit mass; what has hardly any energy, compared with one, is left out."""
        for _ in range(2):  # twice is enough (Kahan)
            new = new - self.basis @ (self.basis.T @ (self.metric @ new))
        values, rotation = np.linalg.eigh(symmetric(new.T @ (self.operator @ new)))
        new = new @ rotation[:, values > DROP * self.tolerance]
        values, rotation = np.linalg.eigh(symmetric(new.T @ (self.metric @ new)))
        return np.asarray(new @ (rotation / np.sqrt(values)))

    def worst(self, errors: np.ndarray) -> int:
        """Training material of the largest certified error; `errors` holds those of the last round.

        Errors mostly fall as the basis grows, so that the earlier largest ones are looked at first; that one above
        the tolerance stays the largest must be seen, but nothing is done until all are known to be below.
        """
        order = np.argsort(-errors, kind="stable")
        for last in range(AT_ONCE, len(order) + AT_ONCE, AT_ONCE):
            block = order[last - AT_ONCE : last]
            errors[block] = self.certified_errors(block)
            if errors[order[:last]].max() > max(
                BUILT * self.tolerance, errors[order[last:]].max(initial=0.0)
            ):
                break
        return int(errors.argmax())

    def known_first(self, errors: np.ndarray, worst: int) -> int:
        """Where the error is largest: among the materials of known modes, while one is above the tolerance."""
        if not self.known:
            return worst
        known = np.array(list(self.known))
        errors[known] = self.certified_errors(known)
        best = int(known[errors[known].argmax()])
        return best if errors[best] > BUILT * self.tolerance else worst

    def certified_errors(self, numbers: np.ndarray) -> np.ndarray:
        """Certified errors at some training materials."""
        weights, ratios = self.weights[numbers], self.ratios[numbers]
        return self.space.certified_errors(weights, ratios, self.space.pairs(weights))

    def room(self, members: list[int]) -> RoomBasis:
        """What a room needs of the basis, in the reference's own Ritz vectors: orthogonal in mass and in energy."""
        weights, ratios = self.weights[members], self.ratios[members]
        turn = compression(self.space, weights, ratios, self.tolerance)
        values, rotation = self.space.turned(turn).pairs(self.weights[0])
        turn = turn @ rotation
        space = self.space.turned(turn)
        scales = np.abs(self.weights).max(axis=0)
        scales[space.directions :] *= space.top
        residual = residual_norm(
            space.gram,
            np.where(scales > 0.0, scales, 1.0),
            np.maximum(values, 0.0) + space.shift,
            RESOLVED * self.tolerance,
        )
        error = float(space.certified_errors(weights, ratios, space.pairs(weights)).max())
        stiffness, mass = np.split(space.projected, [space.directions])
        return RoomBasis(turn, stiffness, mass, residual, error)
