"""Reduced problems of one room side by side: an evaluation is a handful of array operations."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from statorhom.model.eigenvalue_bounds import eigenvalue_drops, frequency_errors
from statorhom.model.local_basis import SPARE, RoomBasis
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

    def squared_residuals(
        self, pairs: BatchPairs, weights: np.ndarray, densities: np.ndarray, ratio: float, shift: float
    ) -> np.ndarray:
        """Upper bounds (b, j) of rᵀA⁻¹r of the pairs, A of the material itself; `ratio`: see `stiffness_ratio`."""
        b, k = self.padding.shape[:2]
        s, values = len(weights), pairs.values
        elastic = (weights.astype(np.float32) @ self.elastic).reshape(b, -1, k)
        inertial = (densities.astype(np.float32) @ self.inertial).reshape(b, -1, k)
        outside = weights**2 @ self.outside[:s], densities**2 @ self.outside[s:]
        rest = (outside[0][:, None] + outside[1][:, None] * values**2) * (values + shift) / ratio
        return squared_norms(elastic, inertial, rest, values, pairs.vectors) / ratio


def certificates(
    pairs: Sequence[BatchPairs], squared: Sequence[np.ndarray], shift: float
) -> tuple[np.ndarray, ...]:
    """Bounds of the relative errors of all frequencies, per batch (b, j), from the squared residuals."""
    widest = max(p.values.shape[1] for p in pairs)
    # padding is no mode
    real = [np.where(p.values < p.top * FAR**0.5, p.values, np.inf) for p in pairs]
    values, norms = (
        np.vstack(
            [np.pad(part, ((0, 0), (0, widest - part.shape[1])), constant_values=fill) for part in parts]
        )
        for parts, fill in ((real, np.inf), (squared, 0.0))
    )
    errors = frequency_errors(values, eigenvalue_drops(values, norms, shift))
    ends = np.cumsum([len(part) for part in real])[:-1]
    return tuple(e[:, : p.values.shape[1]] for e, p in zip(np.split(errors, ends), pairs, strict=True))


def reduced_batches(
    rooms: Sequence[RoomBasis], profiles: Sequence[np.ndarray], densities: np.ndarray
) -> tuple[ReducedBatch, ...]:
    """Group problems by size.

    Parameters
    ----------
    rooms : per problem its basis in one and the same room.
    profiles : per problem (planes, k) radial order amplitudes of that basis.
    densities : (regions,) at which the batches' vectors have unit mass.
    """
    turned = [_of_unit_mass(r, p, densities) for r, p in zip(rooms, profiles, strict=True)]
    rooms, profiles = [r for r, _ in turned], [p for _, p in turned]
    groups: list[list[int]] = []
    for i in sorted(range(len(rooms)), key=lambda i: -rooms[i].size):
        if groups and rooms[groups[-1][0]].size <= WASTE * rooms[i].size + 1:
            groups[-1].append(i)
        else:
            groups.append([i])
    return tuple(_batch(group, rooms, profiles) for group in groups)


def _of_unit_mass(
    room: RoomBasis, profile: np.ndarray, densities: np.ndarray
) -> tuple[RoomBasis, np.ndarray]:
    """The same basis with vectors that have unit mass at given densities."""
    turn = np.linalg.inv(np.linalg.cholesky(np.tensordot(densities, room.mass, axes=1))).T
    residual = replace(room.residual, factor=(room.residual.factor @ turn).astype(np.float32))
    stiffness, mass = (turn.T @ terms @ turn for terms in (room.stiffness, room.mass))
    return RoomBasis(room.turn @ turn, stiffness, mass, residual, room.error), profile @ turn


def _batch(
    numbers: Sequence[int], rooms: Sequence[RoomBasis], profiles: Sequence[np.ndarray]
) -> ReducedBatch:
    chosen = [rooms[i] for i in numbers]
    s = chosen[0].stiffness.shape[0]
    k = max(r.size for r in chosen)
    p = max(r.residual.factor.shape[1] for r in chosen)
    b = len(chosen)
    padding = np.zeros((b, k, k))
    for square, r in zip(padding, chosen, strict=True):
        square[range(r.size, k), range(r.size, k)] = 1.0
    factors = _padded([r.residual.factor for r in chosen], (p, k))
    outside = np.stack([r.residual.dropped / r.residual.scales**2 for r in chosen], axis=1)
    return ReducedBatch(
        np.array(numbers),
        _padded([r.stiffness for r in chosen], (k, k)).reshape(s, -1),
        _padded([r.mass for r in chosen], (k, k)).reshape(chosen[0].mass.shape[0], -1),
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
