"""Reduced problems of one cell side by side: an evaluation is a handful of array operations."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from statorhom.model.eigenvalue_bounds import eigenvalue_drops, frequency_errors
from statorhom.model.local_basis import SPARE, LocalBasis
from statorhom.model.residual_norm import squared_norms
from statorhom.model.ritz import ritz_pairs

WASTE = 1.15  # a batch pads its bases to the largest of them, by this factor at most
FAR = 1e8  # of the band's highest eigenvalue: where padding puts its own ones


@dataclass(frozen=True)
class BatchPairs:
    """Ritz pairs of a batch.

    Parameters
    ----------
    values : (b, j) ascending; the first of every row lie in the band.
    vectors : (b, k, j).
    counts : (b,) how many lie in the band.
    top : highest eigenvalue of the band.
    """

    values: np.ndarray
    vectors: np.ndarray
    counts: np.ndarray
    top: float


@dataclass(frozen=True)
class ReducedBatch:
    """Reduced problems of similar size, padded to one.

    Parameters
    ----------
    problems : (b,) their numbers.
    stiffness : (s, b·k·k).
    mass : (regions, b·k·k).
    padding : (b, k, k) that keeps what is padded out of the band.
    elastic, inertial : (s, b·p·k) and (regions, b·p·k) of the residuals' factors.
    outside : (s + regions, b) of the residuals' remainders, per square of weight.
    profiles : (b, planes, k) radial order amplitudes of the basis.
    """

    problems: np.ndarray
    stiffness: np.ndarray
    mass: np.ndarray
    padding: np.ndarray
    elastic: np.ndarray
    inertial: np.ndarray
    outside: np.ndarray
    profiles: np.ndarray

    def pairs(self, weights: np.ndarray, densities: np.ndarray, top: float, *, unit_mass: bool) -> BatchPairs:
        """Ritz pairs up to λ = `top` and a few more; `unit_mass`: the densities are the reference's."""
        shape = self.padding.shape
        K = (weights @ self.stiffness).reshape(shape) + top * FAR * self.padding
        M = None if unit_mass else (densities @ self.mass).reshape(shape) + self.padding
        values, vectors = ritz_pairs(K, M)
        counts = (values <= top).sum(axis=1)
        used = int(counts.max()) + SPARE
        return BatchPairs(values[:, :used], vectors[:, :, :used], counts, top)

    def certificate(
        self, pairs: BatchPairs, weights: np.ndarray, densities: np.ndarray, ratio: float, shift: float
    ) -> np.ndarray:
        """Bounds of the relative errors of all frequencies (b, j)."""
        b, k = self.padding.shape[:2]
        s, values = len(weights), pairs.values
        elastic = (weights.astype(np.float32) @ self.elastic).reshape(b, -1, k)
        inertial = (densities.astype(np.float32) @ self.inertial).reshape(b, -1, k)
        rest = (weights**2 @ self.outside[:s])[:, None] + (densities**2 @ self.outside[s:])[
            :, None
        ] * values**2
        squared = squared_norms(elastic, inertial, rest * (values + shift) / ratio, values, pairs.vectors)
        # padding is no mode
        real = np.where(values < pairs.top * FAR**0.5, values, np.inf)
        return frequency_errors(real, eigenvalue_drops(real, squared / ratio, shift))


def reduced_batches(
    cells: Sequence[LocalBasis], profiles: Sequence[np.ndarray], densities: np.ndarray
) -> tuple[ReducedBatch, ...]:
    """Group problems by size.

    Parameters
    ----------
    cells : per problem its basis in one and the same cell.
    profiles : per problem (planes, k) radial order amplitudes of that basis.
    densities : (regions,) at which the batches' vectors have unit mass.
    """
    turned = [_of_unit_mass(c, p, densities) for c, p in zip(cells, profiles, strict=True)]
    cells, profiles = [c for c, _ in turned], [p for _, p in turned]
    order = sorted(range(len(cells)), key=lambda i: -cells[i].basis.shape[1])
    groups: list[list[int]] = []
    for i in order:
        k = cells[i].basis.shape[1]
        if groups and cells[groups[-1][0]].basis.shape[1] <= WASTE * k + 1:
            groups[-1].append(i)
        else:
            groups.append([i])
    return tuple(_batch(group, cells, profiles) for group in groups)


def _of_unit_mass(
    cell: LocalBasis, profile: np.ndarray, densities: np.ndarray
) -> tuple[LocalBasis, np.ndarray]:
    """The same basis with vectors that have unit mass at given densities."""
    turn = np.linalg.inv(np.linalg.cholesky(np.tensordot(densities, cell.mass, axes=1))).T
    residual = replace(cell.residual, factor=(cell.residual.factor @ turn).astype(np.float32))
    made = LocalBasis(
        cell.basis @ turn, turn.T @ cell.stiffness @ turn, turn.T @ cell.mass @ turn, residual, cell.error
    )
    return made, profile @ turn


def _batch(
    numbers: Sequence[int], cells: Sequence[LocalBasis], profiles: Sequence[np.ndarray]
) -> ReducedBatch:
    chosen = [cells[i] for i in numbers]
    s = chosen[0].stiffness.shape[0]
    k = max(c.basis.shape[1] for c in chosen)
    p = max(c.residual.factor.shape[1] for c in chosen)
    b = len(chosen)
    padding = np.zeros((b, k, k))
    for square, c in zip(padding, chosen, strict=True):
        first = c.basis.shape[1]
        square[range(first, k), range(first, k)] = 1.0
    factors = _padded([c.residual.factor for c in chosen], (p, k))
    outside = np.stack([c.residual.dropped / c.residual.scales**2 for c in chosen], axis=1)
    return ReducedBatch(
        np.array(numbers),
        _padded([c.stiffness for c in chosen], (k, k)).reshape(s, -1),
        _padded([c.mass for c in chosen], (k, k)).reshape(chosen[0].mass.shape[0], -1),
        padding,
        factors[:s].reshape(s, -1),
        factors[s:].reshape(len(factors) - s, -1),
        outside,
        _padded([profiles[i][None] for i in numbers], (len(profiles[0]), k))[0],
    )


def _padded(arrays: Sequence[np.ndarray], shape: tuple[int, int]) -> np.ndarray:
    """Arrays (t, rows, columns) side by side, each filled up with zeros: (t, b, *shape)."""
    result = np.zeros((arrays[0].shape[0], len(arrays), *shape), arrays[0].dtype)
    for i, array in enumerate(arrays):
        result[:, i, : array.shape[1], : array.shape[2]] = array
    return result
