"""Pieces of all copies between the waves of all harmonics.

With a = û e^{i k h α} and b = û' e^{i k h' α} a piece k_e gives Re(a)ᵀ k_e Re(b) = ½ Re(aᴴ k_e b + aᵀ k_e b), and
alike for the imaginary parts: of the slots only the sums of the weights times e^{i k (h' ∓ h) α} enter. The products
ûᴴ k_e û' and ûᵀ k_e û' of the half pitch are made once per group of pieces that always have the same weights.
"""

from __future__ import annotations

from collections import OrderedDict
from dataclasses import dataclass, field

import numpy as np

from statorhom.model.broken.pieces import Pieces
from statorhom.model.broken.waves import Waves

KEPT_BYTES = 2**30  # of products that each basis keeps: those of a large one take 60 MB a group


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
    """Products that were made before, the latest ones."""

    known: OrderedDict[tuple[int, int, int, bytes], tuple[Pieces, Gram]] = field(default_factory=OrderedDict)

    def gram(self, pieces: Pieces, group: np.ndarray, rows: Waves, columns: Waves) -> Gram:
        """Products of the group (numbers of pieces)."""
        key = (id(pieces), id(rows), id(columns), group.tobytes())
        if key not in self.known:
            # the pieces are kept too, so that their id stays theirs
            self.known[key] = (pieces, _gram(pieces.take(group), rows, columns))
            self._forget()
        return self.known[key][1]

    def _forget(self) -> None:
        """Drop the oldest, but never the one that is needed now."""
        size = sum(gram.size for _, gram in self.known.values())
        while size > KEPT_BYTES and len(self.known) > 1:
            _, (_, oldest) = self.known.popitem(last=False)
            size -= oldest.size


def project(cache: GramCache, pieces: Pieces, weights: np.ndarray, rows: Waves, columns: Waves) -> np.ndarray:
    """Weighted pieces of all copies between coordinates, (len(rows), len(columns)).

    Parameters
    ----------
    weights : (e, 2 N) per piece and half pitch.
    """
    used = np.flatnonzero(np.any(weights != 0.0, axis=1))
    shape = (len(rows.order), len(columns.order))
    same, twice = np.zeros(shape, dtype=complex), np.zeros(shape, dtype=complex)
    N = rows.slots
    difference = (columns.order - rows.order[:, None]) % N
    total = (columns.order + rows.order[:, None]) % N
    patterns, member = np.unique(weights[used], axis=0, return_inverse=True)
    for i, pattern in enumerate(patterns):
        gram = cache.gram(pieces, used[member.ravel() == i], rows, columns)
        straight, mirrored = (N * np.fft.ifft(pattern[side::2]) for side in (0, 1))
        same += gram.hermitian * straight[difference] + np.conj(gram.hermitian) * mirrored[difference]
        twice += gram.transposed * straight[total] + np.conj(gram.transposed) * mirrored[total]
    return _families(same, twice, rows, columns)


def _gram(pieces: Pieces, rows: Waves, columns: Waves) -> Gram:
    dofs, local = np.unique(pieces.dofs, return_inverse=True)
    part = Pieces(local.reshape(pieces.dofs.shape), pieces.matrices, len(dofs))
    images = part.matrix(np.ones(len(part))) @ columns.shapes[dofs]
    left = rows.shapes[dofs].T
    return Gram(np.conj(left) @ images, left @ images)


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
