"""Build the basis of a cell: greedy snapshots at the largest certified error, then no more than they need."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.linalg import eigh

from statorhom.model.eigen import factorize, modes_below
from statorhom.model.eigenvalue_bounds import eigenvalue_drops, frequency_errors
from statorhom.model.harmonic_terms import HarmonicTerms
from statorhom.model.local_basis import SPARE, LocalBasis, norm_shift
from statorhom.model.material_cells import stiffness_ratio
from statorhom.model.material_span import MaterialPoint
from statorhom.model.residual_norm import residual_norm
from statorhom.model.ritz import ritz_pairs

BEYOND = 1  # modes above the band in every snapshot: the bounds need to know what comes next
DROP = 0.2  # of the tolerance: the energy below which a new direction may be left out
BUILT = 0.6  # of the tolerance: what the greedy basis meets before it is compressed to the tolerance
RESOLVED = 1e-5  # of the tolerance: the part of the energy that residuals need not resolve; gaps magnify it


def local_basis(
    terms: HarmonicTerms,
    training: Sequence[MaterialPoint],
    highest_hz: float,
    tolerance: float,
    most: int,
) -> LocalBasis:
    """Build the basis of a cell.

    Parameters
    ----------
    terms : of the harmonic.
    training : materials of the cell; the norm of the residuals is that of the first.
    highest_hz : upper end of the band in which modes are to be exact.
    tolerance : certified relative frequency error to stay below.
    most : largest number of snapshots.
    """
    builder = _Builder(terms, training, highest_hz, tolerance)
    builder.add_snapshot(0)
    errors = np.full(len(training), np.inf)
    for _ in range(most - 1):
        worst = builder.worst(errors)
        if errors[worst] <= BUILT * tolerance:
            # a certificate does not see a mode that the basis misses altogether; the full model does
            worst = builder.farthest()
            if builder.true_error(worst) <= tolerance:
                break
        if not builder.add_snapshot(worst):
            break
    builder.compress()
    return builder.finished(builder.largest_error())


class _Builder:
    """The growing basis and its images."""

    def __init__(
        self,
        terms: HarmonicTerms,
        training: Sequence[MaterialPoint],
        highest_hz: float,
        tolerance: float,
    ) -> None:
        self.terms, self.training = terms, training
        self.highest_hz, self.tolerance = highest_hz, tolerance
        self.top, self.shift = (2 * np.pi * highest_hz) ** 2, norm_shift(highest_hz)
        K, self.metric = terms.matrices(training[0])
        self.operator = K + self.shift * self.metric
        self.solve = factorize(self.operator)
        self.weights = [np.r_[terms.span.weights(p), p.density] for p in training]
        self.directions = terms.span.size
        size, count = self.operator.shape[0], len(self.weights[0])
        self.basis = np.empty((size, 0))
        self.images = np.empty((count, size, 0))
        self.seen = np.empty((count, size, 0))  # the images through the inverse of the reference's operator
        self.expected = 8
        self.solved: dict[int, tuple[np.ndarray, np.ndarray]] = {}  # the last full solution

    def farthest(self) -> int:
        """The training material least like the reference."""
        return int(np.argmin([stiffness_ratio(p, self.training[0]) for p in self.training]))

    def true_error(self, number: int) -> float:
        """Relative frequency error at a training material, infinite where a mode is missing."""
        exact = self._full_modes(number)[0]
        return self._deviation(exact[exact <= self.top], self._pairs(number)[0])

    def add_snapshot(self, number: int) -> bool:
        """Take in a material's modes; False where they bring nothing new."""
        new = self._new_directions(self._full_modes(number)[1])
        if new.shape[1] == 0:
            return False
        images = self.terms.images(new)
        count, size, columns = images.shape
        seen = self.solve(np.ascontiguousarray(images.transpose(1, 0, 2).reshape(size, -1)))
        self.basis = np.hstack([self.basis, new])
        self.images = np.concatenate([self.images, images], axis=2)
        self.seen = np.concatenate([self.seen, seen.reshape(size, count, columns).transpose(1, 0, 2)], axis=2)
        self.projected = _symmetric(self.basis.T @ self.images)
        return True

    def _full_modes(self, number: int) -> tuple[np.ndarray, np.ndarray]:
        if number not in self.solved:
            K, M = self.terms.matrices(self.training[number])
            found = modes_below(K, M, self.highest_hz, self.expected, beyond=BEYOND)
            self.expected = len(found[0]) + 2
            self.solved = {number: found}
        return self.solved[number]

    def _deviation(self, values: np.ndarray, found: np.ndarray) -> float:
        """Largest relative frequency error of Ritz values."""
        if len(found) < len(values):
            return float("inf")
        drops = np.maximum(found[: len(values)] - values, 0.0)
        return float(frequency_errors(found[: len(values)], drops).max(initial=0.0))

    def _pairs(self, number: int) -> tuple[np.ndarray, np.ndarray]:
        w, s = self.weights[number], self.directions
        return ritz_pairs(self._reduced(w, slice(s)), self._reduced(w, slice(s, None)))

    def _new_directions(self, vectors: np.ndarray) -> np.ndarray:
        """What the vectors add to the basis, of unit mass; what has hardly any energy is left out."""
        new = vectors / np.sqrt(np.einsum("ij,ij->j", vectors, self.operator @ vectors))
        for _ in range(2):  # twice is enough (Kahan)
            new = new - self.basis @ (self.basis.T @ (self.metric @ new))
        values, rotation = np.linalg.eigh(_symmetric(new.T @ (self.operator @ new)))
        new = new @ rotation[:, values > DROP * self.tolerance]
        values, rotation = np.linalg.eigh(_symmetric(new.T @ (self.metric @ new)))
        return np.asarray(new @ (rotation / np.sqrt(values)))

    def worst(self, errors: np.ndarray) -> int:
        """Training material of the largest certified error; `errors` holds those of the last round.

        Errors mostly fall as the basis grows, so that the earlier largest ones are looked at first; that one above
        the tolerance stays the largest must be seen, but nothing is done until all are known to be below.
        """
        for number in np.argsort(-errors, kind="stable"):
            errors[number] = self.certified_error(int(number))
            following = np.delete(errors, number)
            if errors[number] > max(BUILT * self.tolerance, following.max(initial=0.0)):
                return int(number)
        return int(errors.argmax())

    def certified_error(self, number: int) -> float:
        """Certified relative frequency error at a training material."""
        w = self.weights[number]
        values, vectors = self._pairs(number)
        used = int((values <= self.top).sum()) + SPARE
        values, vectors = values[:used], vectors[:, :used]
        residual, dual = (self._combined(images, w, values, vectors) for images in (self.images, self.seen))
        squared = np.einsum("ij,ij->j", residual, dual) / stiffness_ratio(
            self.training[number], self.training[0]
        )
        drops = eigenvalue_drops(values, np.maximum(squared, 0.0), self.shift)
        errors = frequency_errors(values, drops)
        return float(errors[values <= self.top].max(initial=0.0))

    def _combined(
        self, images: np.ndarray, w: np.ndarray, values: np.ndarray, vectors: np.ndarray
    ) -> np.ndarray:
        """Residuals of Ritz pairs, from the images or from what the norm makes of them."""
        s = self.directions
        elastic = np.tensordot(w[:s], images[:s] @ vectors, axes=1)
        return np.asarray(elastic - np.tensordot(w[s:], images[s:] @ vectors, axes=1) * values)

    def largest_error(self) -> float:
        """Largest certified error at the training materials."""
        return max(self.certified_error(i) for i in range(len(self.training)))

    def compress(self) -> None:
        """Keep of the basis what the modes of all training materials need most, while they stay certified.

        The directions are ordered by their share in the modes' energy (proper orthogonal decomposition), and as
        many are kept as a bisection finds necessary.
        """
        if self.largest_error() > self.tolerance:
            return
        pairs = [self._pairs(i) for i in range(len(self.training))]
        modes = [values[values <= self.top] for values, _ in pairs]
        turn = self._by_energy(pairs)
        whole = self.basis, self.images, self.seen
        enough, few = turn.shape[1], 0
        while enough - few > 1:
            middle = (enough + few) // 2
            self._turn(whole, turn[:, :middle])
            # modes that are lost have no certificate
            lost = max(self._deviation(m, self._pairs(i)[0]) for i, m in enumerate(modes))
            if lost <= self.tolerance and self.largest_error() <= self.tolerance:
                enough = middle
            else:
                few = middle
        self._turn(whole, turn[:, :enough])

    def _by_energy(self, pairs: Sequence[tuple[np.ndarray, np.ndarray]]) -> np.ndarray:
        """Basis of the reduced space (k, k), orthonormal in the reference's energy, the most needed first."""
        s = self.directions
        found = []
        for values, vectors in pairs:
            used = int((values <= self.top).sum()) + BEYOND
            found.append(vectors[:, :used] / np.sqrt(np.maximum(values[:used], 0.0) + self.shift))
        energy = self._reduced(self.weights[0], slice(s)) + self.shift * self._reduced(
            self.weights[0], slice(s, None)
        )
        root = np.linalg.cholesky(energy).T
        return np.asarray(np.linalg.solve(root, np.linalg.svd(root @ np.hstack(found))[0]))

    def _turn(self, whole: tuple[np.ndarray, np.ndarray, np.ndarray], turn: np.ndarray) -> None:
        self.basis, self.images, self.seen = (part @ turn for part in whole)
        self.projected = _symmetric(self.basis.T @ self.images)

    def _reduced(self, w: np.ndarray, terms: slice) -> np.ndarray:
        return np.asarray(np.tensordot(w[terms], self.projected[terms], axes=1))

    def finished(self, error: float) -> LocalBasis:
        """The basis so far, turned into the reference's own Ritz vectors: orthogonal in mass and in energy."""
        s, w = self.directions, self.weights[0]
        values, turn = eigh(self._reduced(w, slice(s)), self._reduced(w, slice(s, None)))
        projected = _symmetric(turn.T @ self.projected @ turn)
        count, size, k = self.images.shape
        flat, seen = ((a @ turn).transpose(1, 0, 2).reshape(size, -1) for a in (self.images, self.seen))
        scales = np.abs(self.weights).max(axis=0)
        scales[s:] *= self.top
        residual = residual_norm(
            _symmetric(flat.T @ seen).reshape(count, k, count, k),
            np.where(scales > 0.0, scales, 1.0),
            np.maximum(values, 0.0) + self.shift,
            RESOLVED * self.tolerance,
        )
        return LocalBasis(self.basis @ turn, projected[:s], projected[s:], residual, error)


def _symmetric(matrices: np.ndarray) -> np.ndarray:
    return (matrices + np.swapaxes(matrices, -1, -2)) / 2
