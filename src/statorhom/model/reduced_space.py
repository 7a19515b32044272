"""A growing basis as its own matrices know it: Ritz pairs and their certificates without the full space."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from statorhom.model.eigenvalue_bounds import eigenvalue_drops, frequency_errors
from statorhom.model.local_basis import SPARE
from statorhom.model.ritz import ritz_pairs


@dataclass(frozen=True)
class ReducedSpace:
    """One harmonic in a basis Φ of k vectors.

    Parameters
    ----------
    projected : (t, k, k) of every term: ΦᵀK_aΦ, then ΦᵀM_bΦ.
    gram : (t, k, t, k) inner products of the terms' images of Φ in the norm of A⁻¹ of the reference.
    directions : how many of the terms are stiffnesses.
    top : highest eigenvalue of the band.
    shift : σ of A = K + σM.
    """

    projected: np.ndarray
    gram: np.ndarray
    directions: int
    top: float
    shift: float

    @property
    def size(self) -> int:
        """k."""
        return int(self.projected.shape[-1])

    def matrices(self, weights: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """K and M for weights (t,) of the terms."""
        s = self.directions
        K, M = (np.tensordot(weights[a], self.projected[a], axes=1) for a in (slice(s), slice(s, None)))
        return np.asarray(K), np.asarray(M)

    def pairs(self, weights: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """All Ritz pairs."""
        return ritz_pairs(*self.matrices(weights))

    def certified_error(self, weights: np.ndarray, ratio: float) -> float:
        """Largest certified relative frequency error in the band; `ratio`: see `stiffness_ratio`."""
        values, vectors = self.pairs(weights)
        used = int((values <= self.top).sum()) + SPARE
        values, vectors = values[:used], vectors[:, :used]
        parts = weights[:, None, None] * vectors
        parts[self.directions :] *= -values
        z = parts.reshape(-1, parts.shape[-1])
        # rounding of the products, 1e-16 of the largest, is far below the squares that matter
        squared = np.einsum("ij,ij->j", z, self.gram.reshape(len(z), -1) @ z) / ratio
        errors = frequency_errors(values, eigenvalue_drops(values, np.maximum(squared, 0.0), self.shift))
        return float(errors[values <= self.top].max(initial=0.0))

    def turned(self, turn: np.ndarray) -> ReducedSpace:
        """The space of ΦT for T (k, …)."""
        half = np.tensordot(self.gram, turn, axes=(3, 0))
        gram = np.tensordot(turn, half, axes=(0, 1)).transpose(1, 0, 2, 3)
        projected = symmetric(turn.T @ self.projected @ turn)
        return ReducedSpace(projected, gram, self.directions, self.top, self.shift)


def largest_deviation(exact: np.ndarray, found: np.ndarray) -> float:
    """Largest relative frequency error of Ritz values; infinite where modes are missing."""
    if len(found) < len(exact):
        return float("inf")
    drops = np.maximum(found[: len(exact)] - exact, 0.0)
    return float(frequency_errors(found[: len(exact)], drops).max(initial=0.0))


def symmetric(matrices: np.ndarray) -> np.ndarray:
    """Symmetric part of matrices (…, k, k)."""
    return np.asarray((matrices + np.swapaxes(matrices, -1, -2)) / 2)
