"""A reduced basis per harmonic over a box of materials: one evaluation never touches the full model.

The basis collects the modes of a few materials, each chosen where the basis so far seems worst (greedy). How bad it
is there follows from the residual r = K x - λ M x of a reduced mode: seen through the model at the first material,
‖r‖² in the norm of (K + σ M)⁻¹ over the distance to the next eigenvalue estimates the error of λ, because Ritz
values err quadratically. The estimate only ranks: the full modes that a snapshot brings tell the true error.
"""

from __future__ import annotations

import heapq
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from scipy.linalg import eigh, solve_triangular
from threadpoolctl import threadpool_limits

from statorhom.model.affine import AffineModel, Materials, hooke_coefficients
from statorhom.model.assembly import HOOKE_ENTRIES
from statorhom.model.eigen import SHIFT, factorize, modes_below
from statorhom.model.harmonic import Harmonic

DROP = 1e-7  # a direction whose part outside the basis is smaller than this adds only rounding
BAND_MARGIN = 1.4  # snapshots reach beyond the band: modes enter it as materials soften
PATIENCE = 3  # seemingly worst materials in a row at which the basis must prove exact
UNIT_MASS = (
    1e-8  # how far M may lie from the identity and still count as it, the rounding of the orthonormalization
)

Coefficients = Mapping[str, tuple[np.ndarray, float]]


def coefficients(materials: Materials) -> dict[str, tuple[np.ndarray, float]]:
    """Region → its nine Hooke entries and its density: what the affine operators are weighted with."""
    return {region: (hooke_coefficients(m.hooke), m.density) for region, m in materials.items()}


@dataclass(frozen=True)
class ReducedHarmonic:
    """One harmonic in its reduced basis.

    Parameters
    ----------
    harmonic : the full space.
    basis : (m, k) coordinates of the basis in that space.
    stiffness : region → (9, k, k) per unit Hooke entry.
    mass : region → (k, k) per unit density.
    error : largest relative frequency error that was met at the training materials that seemed the worst.
    """

    harmonic: Harmonic
    basis: np.ndarray
    stiffness: Mapping[str, np.ndarray]
    mass: Mapping[str, np.ndarray]
    error: float

    def matrices(self, coefficients: Coefficients) -> tuple[np.ndarray, np.ndarray]:
        """K and M in the reduced basis, (k, k) each."""
        size = self.basis.shape[1]
        K, M = np.zeros(size * size), np.zeros((size, size))
        for region, terms in self.stiffness.items():
            hooke, density = coefficients[region]
            K += hooke @ terms.reshape(len(hooke), -1)
            M += density * self.mass[region]
        return K.reshape(size, size), M

    def modes(self, coefficients: Coefficients, highest_hz: float) -> tuple[np.ndarray, np.ndarray]:
        """Eigenvalues (rad²/s²) up to a frequency and their coordinates (k, …), mass-normalised in the half pitch."""
        return lowest_pairs(*self.matrices(coefficients), (2 * np.pi * highest_hz) ** 2)


def lowest_pairs(K: np.ndarray, M: np.ndarray, top: float) -> tuple[np.ndarray, np.ndarray]:
    """Eigenvalues up to `top` of K x = λ M x with dense K and M, and their M-normalised vectors."""
    if np.abs(M - np.eye(len(M))).max() < UNIT_MASS:  # as at the densities of a basis's first material
        return _standard_pairs(K, top)
    L = np.linalg.cholesky(M)
    half = solve_triangular(L, K, lower=True, check_finite=False)
    values, vectors = _standard_pairs(solve_triangular(L, half.T, lower=True, check_finite=False), top)
    return values, solve_triangular(L, vectors, lower=True, trans="T", check_finite=False)


def _standard_pairs(matrix: np.ndarray, top: float) -> tuple[np.ndarray, np.ndarray]:
    found: tuple[np.ndarray, np.ndarray] = eigh(
        matrix, check_finite=False, driver="evr", subset_by_value=(-np.inf, top)
    )
    return found


def reduce_harmonic(
    model: AffineModel,
    harmonic: Harmonic,
    training: Sequence[Materials],
    highest_hz: float,
    tolerance: float = 3e-4,
    most: int = 60,
) -> ReducedHarmonic:
    """Build the reduced basis of a harmonic.

    Parameters
    ----------
    model : the affine model.
    harmonic : the harmonic's space.
    training : materials that cover the box; the first is its centre.
    highest_hz : modes up to here are to be exact.
    tolerance : relative frequency error; `PATIENCE` snapshots in a row must meet it before they are taken in.
    most : largest number of snapshots.
    """
    with threadpool_limits(limits=1, user_api="blas"):
        builder = _Builder(model, harmonic, training[0], highest_hz)
        error = _greedy(builder, training[1:], tolerance, most)
    return builder.reduced(error)


def _greedy(builder: _Builder, training: Sequence[Materials], tolerance: float, most: int) -> float:
    """Take snapshots where the estimate is largest; estimates only fall, so stale ones are bounds."""
    heap = [(-np.inf, i) for i in range(len(training))]
    fresh: dict[int, int] = {}
    errors: list[float] = []
    while heap and len(errors) + 1 < most:
        _, i = heapq.heappop(heap)
        if fresh.get(i) != len(errors):
            fresh[i] = len(errors)
            heapq.heappush(heap, (-builder.estimate(training[i]), i))
            continue
        errors.append(builder.add_snapshot(training[i]))
        if len(errors) >= PATIENCE and max(errors[-PATIENCE:]) < tolerance:
            break
    return max(errors[-PATIENCE:], default=0.0)


class _Builder:
    """The growing basis and what its residuals need."""

    def __init__(
        self, model: AffineModel, harmonic: Harmonic, reference: Materials, highest_hz: float
    ) -> None:
        self.model, self.harmonic, self.highest_hz = model, harmonic, highest_hz
        self.terms = {
            r: [harmonic.project(model.stiffness_term(r, q)) for q in range(len(HOOKE_ENTRIES))]
            for r in model.stiffness
        }
        self.masses = {r: harmonic.project(model.mass_term(r)) for r in model.mass}
        self.metric = harmonic.project(model.mass_matrix(reference))
        self.top = (2 * np.pi * highest_hz) ** 2
        self.shift = SHIFT * self.top
        stiffness = harmonic.project(model.stiffness_matrix(reference))
        self.solve = factorize(sp.csr_array(stiffness + self.shift * self.metric))
        size = harmonic.real.shape[1]
        self.basis = np.empty((size, 0))
        # images of the basis under every affine term: residuals and projections are dense products of them
        self.k_images = {r: np.empty((len(HOOKE_ENTRIES), size, 0)) for r in self.terms}
        self.m_images = {r: np.empty((size, 0)) for r in self.masses}
        self._append(self._full_modes(reference)[1])

    def reduced(self, error: float) -> ReducedHarmonic:
        """The harmonic in the basis so far."""
        return ReducedHarmonic(self.harmonic, self.basis, self.stiffness, self.mass, error)

    def add_snapshot(self, materials: Materials) -> float:
        """Take in a material's modes; return the largest relative frequency error of the basis before that."""
        exact, vectors = self._full_modes(materials)
        exact = exact[exact <= self.top]
        reduced = self._reduced_modes(materials)[0][: len(exact)]
        self._append(vectors)
        if len(reduced) < len(exact):
            return float("inf")
        # a rigid body's eigenvalue is all rounding
        return float(np.max((reduced - exact) / (2 * np.maximum(exact, self.shift)), initial=0.0))

    def _full_modes(self, materials: Materials) -> tuple[np.ndarray, np.ndarray]:
        K = self.harmonic.project(self.model.stiffness_matrix(materials))
        M = self.harmonic.project(self.model.mass_matrix(materials))
        return modes_below(K, M, BAND_MARGIN * self.highest_hz)

    def _reduced_modes(self, materials: Materials) -> tuple[np.ndarray, np.ndarray]:
        return self.reduced(np.nan).modes(coefficients(materials), BAND_MARGIN * self.highest_hz)

    def _append(self, vectors: np.ndarray) -> None:
        new = vectors / np.sqrt(np.einsum("ij,ij->j", vectors, self.metric @ vectors))
        for _ in range(2):  # twice is enough (Kahan)
            new = new - self.basis @ (self.basis.T @ (self.metric @ new))
        gram = new.T @ (self.metric @ new)
        values, rotation = np.linalg.eigh((gram + gram.T) / 2)
        keep = values > DROP**2
        new = new @ (rotation[:, keep] / np.sqrt(values[keep]))
        self.basis = np.hstack([self.basis, new])
        for region, terms in self.terms.items():
            images = np.stack([term @ new for term in terms])
            self.k_images[region] = np.concatenate([self.k_images[region], images], axis=2)
            self.m_images[region] = np.hstack([self.m_images[region], self.masses[region] @ new])
        self._project()

    def _project(self) -> None:
        self.stiffness = {r: _symmetric(self.basis.T @ images) for r, images in self.k_images.items()}
        self.mass = {r: _symmetric(self.basis.T @ images) for r, images in self.m_images.items()}

    def estimate(self, materials: Materials) -> float:
        """Estimated largest relative frequency error of the reduced modes in the band."""
        values, vectors = self._reduced_modes(materials)
        inside = int((values <= self.top).sum())
        if inside == 0:
            return 0.0
        residual = self._residuals(materials, values[:inside], vectors[:, :inside])
        squared = np.einsum("ij,ij->j", residual, self.solve(np.ascontiguousarray(residual)))
        # λ̃ - λ = Σ c²(λ_i - λ) and ‖r‖² = Σ c²(λ_i - λ)²/(λ_i + σ) over the missing modes i, all above a next one
        following = values[inside] if len(values) > inside else BAND_MARGIN**2 * self.top
        spread = (following + self.shift) / np.maximum(following - values[:inside], 0.1 * following)
        return float(np.max(0.5 * squared * spread / np.maximum(values[:inside], self.shift)))

    def _residuals(self, materials: Materials, values: np.ndarray, vectors: np.ndarray) -> np.ndarray:
        total = np.zeros((self.basis.shape[0], len(values)))
        for region, images in self.k_images.items():
            # first the modes, then the Hooke entries: the images are large and the modes few
            combined = np.tensordot(hooke_coefficients(materials[region].hooke), images @ vectors, axes=1)
            total += combined - materials[region].density * (self.m_images[region] @ vectors) * values
        return total


def _symmetric(matrices: np.ndarray) -> np.ndarray:
    return (matrices + np.swapaxes(matrices, -1, -2)) / 2
