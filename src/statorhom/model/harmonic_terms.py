"""The affine terms of a harmonic on one sparsity pattern: its matrices at any material are a weighted sum."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from statorhom.mesh.hex_mesh import PartMesh
from statorhom.model.affine import AffineModel
from statorhom.model.material_span import MaterialPoint, MaterialSpan
from statorhom.model.space import Space


@dataclass(frozen=True)
class HarmonicTerms:
    """K per direction of the materials and M per region, projected on a harmonic.

    Parameters
    ----------
    span : directions of the materials.
    stiffness, mass : (directions, entries) and (regions, entries) values on the common pattern.
    indices, indptr : of the pattern, symmetric.
    parity : of the harmonic.
    """

    span: MaterialSpan
    stiffness: np.ndarray
    mass: np.ndarray
    indices: np.ndarray
    indptr: np.ndarray
    parity: str

    def matrices(self, point: MaterialPoint) -> tuple[sp.csr_array, sp.csr_array]:
        """K and M at given materials."""
        K = self._matrix(self.span.weights(point) @ self.stiffness)
        return K, self._matrix(point.density @ self.mass)

    def images(self, vectors: np.ndarray) -> np.ndarray:
        """All terms times vectors (m, j), stiffnesses first: (terms, m, j)."""
        return np.stack([self._matrix(data) @ vectors for data in (*self.stiffness, *self.mass)])

    def _matrix(self, data: np.ndarray) -> sp.csr_array:
        n = len(self.indptr) - 1
        return sp.csr_array((data, self.indices, self.indptr), shape=(n, n))


def harmonic_terms(model: AffineModel[PartMesh], harmonic: Space, span: MaterialSpan) -> HarmonicTerms:
    """Project the terms of a model."""
    stiffness = [
        harmonic.project(model.pattern.matrix(_stiffness(model, direction, members)))
        for first, members in span.groups.items()
        for direction in span.directions[first].T
    ]
    mass = [harmonic.project(model.mass_term(region)) for region in span.regions]
    pattern = sp.csr_array(sum(abs(term) for term in (*stiffness, *mass)))
    pattern.sort_indices()
    n = pattern.shape[0]
    places = _keys(pattern, n)

    def spread(terms: list[sp.csr_array]) -> np.ndarray:
        data = np.zeros((len(terms), len(places)))
        for row, term in zip(data, terms, strict=True):
            row[np.searchsorted(places, _keys(term, n))] = term.data
        return data

    return HarmonicTerms(
        span, spread(stiffness), spread(mass), pattern.indices, pattern.indptr, harmonic.parity
    )


def _stiffness(model: AffineModel[PartMesh], direction: np.ndarray, regions: Sequence[str]) -> np.ndarray:
    """Entries of K per unit of a direction in which regions move together; lumps have no stiffness."""
    return model.stiffness_data({region: direction for region in regions if region in model.stiffness})


def _keys(matrix: sp.csr_array, n: int) -> np.ndarray:
    rows = np.repeat(np.arange(n, dtype=np.int64), np.diff(matrix.indptr))
    return np.asarray(rows * n + matrix.indices)
