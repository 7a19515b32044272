"""Reduced problems of one room side by side: an evaluation is a handful of array operations."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import accumulate

import numpy as np

from statorhom.model.eigenvalue_bounds import eigenvalue_drops, frequency_errors
from statorhom.model.local_basis import SPARE, RoomBasis
from statorhom.model.residual_norm import squared_norms
from statorhom.model.ritz import ritz_pairs

WASTE = 1000  # a batch pads its bases to the largest: more entries of matrices than one batch more would cost
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

    @cached_property
    def used(self) -> slice:
        """Rows up to the last one with modes in the band: a view costs less than to pick those that have any."""
        return slice(0, int(np.flatnonzero(self.counts).max(initial=-1)) + 1)


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
        """Upper bounds of rᵀA⁻¹r, A of the material itself, of the problems that count (`BatchPairs.used`).

        Parameters
        ----------
        pairs : of the batch.
        weights, densities : of the material.
        ratio : see `stiffness_ratio`.
        shift : σ of A.
        """
        b, k = self.padding.shape[:2]
        s, rows = len(weights), pairs.used
        values = pairs.values[rows]
        # of a single row, as many stators' densities are, the operator @ is ten times as slow
        elastic = np.dot(weights.astype(np.float32), self.elastic).reshape(b, -1, k)[rows]
        inertial = np.dot(densities.astype(np.float32), self.inertial).reshape(b, -1, k)[rows]
        still, moving = (
            np.dot(w**2, part)[rows, None]
            for w, part in ((weights, self.outside[:s]), (densities, self.outside[s:]))
        )
        rest = (still + moving * values**2) * (values + shift) / ratio
        return squared_norms(elastic, inertial, rest, values, pairs.vectors[rows]) / ratio


def certificates(
    pairs: Sequence[BatchPairs], squared: Sequence[np.ndarray], shift: float
) -> tuple[np.ndarray, ...]:
    """Bounds of the relative errors of the frequencies of several batches, all at once.

    Parameters
    ----------
    pairs : of every batch.
    squared : of every batch the squared residuals of the problems that count (`BatchPairs.used`).
    shift : σ.

    Returns
    -------
    bounds : per batch (b, j); infinite, as nothing is known, for problems that do not count.
    """
    ends = list(accumulate((len(part) for part in squared), initial=0))
    pieces = [slice(*ends[i : i + 2]) for i in range(len(pairs))]
    widest = max(p.values.shape[1] for p in pairs)
    values, norms = np.full((ends[-1], widest), np.inf), np.zeros((ends[-1], widest))
    for p, part, piece in zip(pairs, squared, pieces, strict=True):
        used = p.values[p.used]
        # padding is no mode
        values[piece, : used.shape[1]] = np.where(used < p.top * FAR**0.5, used, np.inf)
        norms[piece, : used.shape[1]] = part
    errors = frequency_errors(values, eigenvalue_drops(values, norms, shift))
    bounds = tuple(np.full_like(p.values, np.inf) for p in pairs)
    for p, bound, piece in zip(pairs, bounds, pieces, strict=True):
        bound[p.used] = errors[piece, : p.values.shape[1]]
    return bounds


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
    return tuple(_batch(group, rooms, profiles) for group in _groups([r.size for r in rooms]))


def _groups(sizes: Sequence[int]) -> list[list[int]]:
    """Numbers of the problems of every batch, the largest first."""
    groups: list[list[int]] = []
    waste = 0
    for i in sorted(range(len(sizes)), key=lambda i: -sizes[i]):
        waste += sizes[groups[-1][0]] ** 2 - sizes[i] ** 2 if groups else 0
        if not groups or waste > WASTE:
            groups.append([])
            waste = 0
        groups[-1].append(i)
    return groups


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
