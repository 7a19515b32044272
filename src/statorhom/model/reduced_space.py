"""A growing basis as its own matrices know it: Ritz pairs and their certificates without the full space."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from statorhom.model.eigenvalue_bounds import eigenvalue_drops, frequency_errors
from statorhom.model.local_basis import SPARE
from statorhom.model.ritz import UNIT_MASS, ritz_pairs


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
        """K and M (…, k, k) for weights (…, t) of the terms."""
        s = self.directions
        K = np.tensordot(weights[..., :s], self.projected[:s], axes=1)
        return np.asarray(K), np.asarray(np.tensordot(weights[..., s:], self.projected[s:], axes=1))

    def pairs(self, weights: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """All Ritz pairs (…, k) and (…, k, k) for weights (…, t)."""
        K, M = self.matrices(weights)
        # a box's materials mostly have the densities at which the basis has unit mass
        unit = np.abs(M - np.eye(self.size)).max(initial=0.0) < UNIT_MASS
        return ritz_pairs(K, None if unit else M)

    def certified_errors(
        self, weights: np.ndarray, ratios: np.ndarray, pairs: tuple[np.ndarray, np.ndarray]
    ) -> np.ndarray:
        """Largest certified relative frequency error in the band of each of n materials.

        Parameters
        ----------
        weights : (n, t).
        ratios : (n,) see `stiffness_ratio`.
        pairs : the Ritz pairs at these weights.
        """
        values, vectors = pairs
        used = int((values <= self.top).sum(axis=1).max()) + SPARE
        values, vectors = values[:, :used], vectors[:, :, :used]
        parts = weights[:, :, None, None] * vectors[:, None]
        parts[:, self.directions :] *= -values[:, None, None]
        z = parts.reshape(len(weights), -1, values.shape[1])
        # rounding of the products, 1e-16 of the largest, is far below the squares that matter
        squared = np.einsum("nij,nij->nj", z, self.gram.reshape(z.shape[1], -1) @ z) / ratios[:, None]
        errors = frequency_errors(values, eigenvalue_drops(values, np.maximum(squared, 0.0), self.shift))
        return np.asarray(np.where(values <= self.top, errors, 0.0).max(axis=1))

    def turned(self, turn: np.ndarray) -> ReducedSpace:
        """The space of ΦT for T (k, …)."""
        half = np.tensordot(self.gram, turn, axes=(3, 0))
        gram = np.tensordot(turn, half, axes=(0, 1)).transpose(1, 0, 2, 3)
        projected = symmetric(turn.T @ self.projected @ turn)
        return ReducedSpace(projected, gram, self.directions, self.top, self.shift)


def largest_deviation(exact: np.ndarray, found: np.ndarray, top: float) -> float:
    """Largest relative frequency error of Ritz values (…, k) of the eigenvalues (…, j) up to `top`.

    Infinite where there are fewer Ritz values than eigenvalues.
    """
    inside = exact <= top
    used = int(inside.sum(axis=-1).max())
    if found.shape[-1] < used:
        return float("inf")
    inside, values = inside[..., :used], found[..., :used]
    errors = frequency_errors(values, np.maximum(values - exact[..., :used], 0.0))
    return float(np.where(inside, errors, 0.0).max(initial=0.0))


def symmetric(matrices: np.ndarray) -> np.ndarray:
    """Symmetric part of matrices (…, k, k)."""
    return np.asarray((matrices + np.swapaxes(matrices, -1, -2)) / 2)
