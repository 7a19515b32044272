"""Pieces of all copies between the waves of all harmonics.

With a = û e^{i k h α} and b = û' e^{i k h' α} a piece k_e gives Re(a)ᵀ k_e Re(b) = ½ Re(aᴴ k_e b + aᵀ k_e b), and
alike for the imaginary parts: of the slots only the sums of the weights times e^{i k (h' ∓ h) α} enter. The products
ûᴴ k_e û' and ûᵀ k_e û' of the half pitch are made once per group of pieces that always have the same weights.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from statorhom.model.broken.pieces import Pieces, weighted_alike
from statorhom.model.broken.waves import Waves

KEPT_BYTES = 2**30  # of products that each basis keeps: those of a large one take 60 MB a group

_Key = tuple[int, int, int, bytes]


@dataclass(frozen=True)
class Gram:
    """Products of a group of pieces between columns, (rows, columns) complex each."""

    hermitian: np.ndarray
    transposed: np.ndarray

    @property
    def size(self) -> int:
        """Bytes."""
        return self.hermitian.nbytes + self.transposed.nbytes


@dataclass(frozen=True)
class GramCache:
    """Products that were made before, the latest ones; whoever keeps them keeps the waves as well.

    Parameters
    ----------
    most : bytes that are kept.
    """

    most: int = KEPT_BYTES
    known: OrderedDict[_Key, tuple[Pieces, Gram]] = field(default_factory=OrderedDict)

    def grams(self, pieces: Pieces, group: np.ndarray, rows: Sequence[Waves], columns: Waves) -> list[Gram]:
        """Products of the group (numbers of pieces) between each of some rows and the columns."""
        keys = [(id(pieces), id(r), id(columns), group.tobytes()) for r in rows]
        lacking = [i for i, key in enumerate(keys) if key not in self.known]
        if lacking:
            dofs, images = _images(pieces.take(group), columns)
            for i in lacking:
                # the pieces are kept too, so that their id stays theirs
                self.known[keys[i]] = (pieces, _gram(rows[i].shapes[dofs], images))
        found = [self.known[key][1] for key in keys]
        self._forget()
        return found

    def _forget(self) -> None:
        """Drop the oldest, but never the one that is needed now."""
        size = sum(gram.size for _, gram in self.known.values())
        while size > self.most and len(self.known) > 1:
            _, (_, oldest) = self.known.popitem(last=False)
            size -= oldest.size


def project(cache: GramCache, pieces: Pieces, weights: np.ndarray, rows: Waves, columns: Waves) -> np.ndarray:
    """Weighted pieces of all copies between coordinates, (len(rows), len(columns)).

    Parameters
    ----------
    weights : (e, 2 N) per piece and half pitch.
    """
    return projections(cache, pieces, weights, [rows], columns)[0]


def projections(
    cache: GramCache, pieces: Pieces, weights: np.ndarray, rows: Sequence[Waves], columns: Waves
) -> list[np.ndarray]:
    """The same for several rows: what the pieces make of the columns is asked for once."""
    sums = [_Sums.of(r, columns) for r in rows]
    for group, pattern in weighted_alike(weights):
        found = cache.grams(pieces, group, rows, columns)
        for total, gram in zip(sums, found, strict=True):
            total.add(gram, pattern)
    return [_families(s.same, s.twice, r, columns) for s, r in zip(sums, rows, strict=True)]


@dataclass(frozen=True, eq=False)
class _Sums:
    """Σ aᴴ k b and Σ aᵀ k b over all copies, of rows and columns, as they grow group by group.

    Parameters
    ----------
    same, twice : (rows, columns) complex.
    difference, total : of the columns' and the rows' harmonics.
    slots : N.
    """

    same: np.ndarray
    twice: np.ndarray
    difference: np.ndarray
    total: np.ndarray
    slots: int

    @classmethod
    def of(cls, rows: Waves, columns: Waves) -> _Sums:
        shape, N = (len(rows.order), len(columns.order)), rows.slots
        difference = (columns.order - rows.order[:, None]) % N
        total = (columns.order + rows.order[:, None]) % N
        return cls(np.zeros(shape, dtype=complex), np.zeros(shape, dtype=complex), difference, total, N)

    def add(self, gram: Gram, pattern: np.ndarray) -> None:
        """A group of pieces with weights (2 N,)."""
        straight, mirrored = (self.slots * np.fft.ifft(pattern[side::2]) for side in (0, 1))
        own = gram.hermitian, gram.transposed
        for sums, product, waves in zip(
            (self.same, self.twice), own, (self.difference, self.total), strict=True
        ):
            sums += product * straight[waves] + np.conj(product) * mirrored[waves]


def _images(pieces: Pieces, columns: Waves) -> tuple[np.ndarray, np.ndarray]:
    """Displacements that pieces act on, and what they make of the columns there, (d, columns)."""
    dofs, part = pieces.alone()
    matrix, shapes = part.matrix(np.ones(len(part))), columns.shapes[dofs]
    # a real matrix: half the work of a complex product
    return dofs, matrix @ np.ascontiguousarray(shapes.real) + 1j * (
        matrix @ np.ascontiguousarray(shapes.imag)
    )


def _gram(rows: np.ndarray, images: np.ndarray) -> Gram:
    """Products of rows (d, r) with images (d, c), of which both kinds share the real ones."""
    a, b = (np.ascontiguousarray(x.T) for x in (rows.real, rows.imag))
    c, d = np.ascontiguousarray(images.real), np.ascontiguousarray(images.imag)
    hermitian, transposed = (np.empty((len(a), c.shape[1]), dtype=complex) for _ in range(2))
    # two real products at a time: of large bases each takes half a gigabyte
    ac, bd = a @ c, b @ d
    hermitian.real, transposed.real = ac + bd, ac - bd
    del ac, bd
    ad, bc = a @ d, b @ c
    hermitian.imag, transposed.imag = ad - bc, ad + bc
    return Gram(hermitian, transposed)


def _families(same: np.ndarray, twice: np.ndarray, rows: Waves, columns: Waves) -> np.ndarray:
    """Real products between the families from Σ aᴴ k b and Σ aᵀ k b."""
    plus, minus = same + twice, same - twice
    result = np.empty((len(rows), len(columns)))
    c, d = len(rows.cosine), len(columns.cosine)
    result[:c, :d] = 0.5 * plus.real[np.ix_(rows.cosine, columns.cosine)]
    result[:c, d:] = 0.5 * plus.imag[np.ix_(rows.cosine, columns.sine)]
    result[c:, :d] = -0.5 * minus.imag[np.ix_(rows.sine, columns.cosine)]
    result[c:, d:] = 0.5 * minus.real[np.ix_(rows.sine, columns.sine)]
    return result
