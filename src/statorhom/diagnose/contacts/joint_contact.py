"""The contact of all half pitches between waves, weaker over an arc around θ = 0.

Such an arc is its own mirror image, which keeps cosine and sine shapes apart: of the products between waves
(`statorhom.model.broken.grams`) two real sums are left, one for either, and the contact of a harmonic with another one
is weighed by the two harmonics alone.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
import scipy.sparse as sp

from statorhom.model.broken.grams import Gram, GramCache
from statorhom.model.broken.pieces import Pieces
from statorhom.model.broken.waves import Waves
from statorhom.physics.action import Joint

FloatArray = np.ndarray


@dataclass(frozen=True, eq=False)
class WavesContact:
    """Contact between the waves of one axial parity.

    Parameters
    ----------
    waves : one harmonic after the other.
    pieces : of the contact, normal and tangential, per unit stiffness.
    """

    waves: Waves
    pieces: tuple[Pieces, Pieces]
    _bond: dict[tuple[float, float], Gram] = field(default_factory=dict, repr=False)

    def change(self, joint: Joint, share: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Stiffness between cosine and between sine coordinates.

        Parameters
        ----------
        joint : its contact outside the arc.
        share : (2 N,) part of it that every half pitch adds, the same on both sides of θ = 0.
        """
        bond, waves = self._bonded(joint), self.waves
        straight, mirrored = (waves.slots * np.fft.ifft(share[side::2]) for side in (0, 1))
        even, odd = (straight + mirrored).real, (straight - mirrored).imag
        same = self._weighed(bond.hermitian, even, odd, -1)
        twice = self._weighed(bond.transposed, even, odd, 1)
        cosine, sine = np.ix_(waves.cosine, waves.cosine), np.ix_(waves.sine, waves.sine)
        return 0.5 * (same + twice)[cosine], 0.5 * (same - twice)[sine]

    def halves(self, number: int, vectors: Sequence[FloatArray]) -> list[FloatArray]:
        """(2 N, v²) contact of unit stiffness of every half pitch, between vectors of cosine and between those of sine.

        Parameters
        ----------
        number : of the pieces.
        vectors : (cosine coordinates, v) and (sine coordinates, v).
        """
        dofs, part = self.pieces[number].alone()
        unit = sp.csr_array(part.matrix(np.ones(len(part))))
        count = len(self.waves.cosine)
        found = []
        for first, own in zip((0, count), vectors, strict=True):
            coordinates = np.zeros((len(self.waves), own.shape[1]))
            coordinates[first : first + len(own)] = own
            motion = self.waves.in_copies(dofs, coordinates)
            found.append(np.stack([(m.T @ (unit @ m)).ravel() for m in motion]))
        return found

    def _bonded(self, joint: Joint) -> Gram:
        """Products of the whole contact of a half pitch; the last one is kept, and nothing of what it is made of."""
        stiffness = joint.normal, joint.tangential
        if stiffness not in self._bond:
            self._bond.clear()
            normal, tangential = self.pieces
            # both act on the same displacements: their products are those of one
            matrices = joint.normal * normal.matrices + joint.tangential * tangential.matrices
            bond = replace(normal, matrices=matrices)
            self._bond[stiffness] = GramCache().grams(bond, np.arange(len(bond)), [self.waves], self.waves)[0]
        return self._bond[stiffness]

    def _weighed(self, product: np.ndarray, even: FloatArray, odd: FloatArray, sign: int) -> FloatArray:
        """Real part of a product, weighed by the sums or the differences of the harmonics."""
        orders, counts = self._harmonics
        waves = (orders + sign * orders[:, None]) % self.waves.slots
        one, other = (
            np.repeat(np.repeat(table[waves], counts, axis=0), counts, axis=1) for table in (even, odd)
        )
        return np.asarray(product.real * one - product.imag * other)

    @property
    def _harmonics(self) -> tuple[np.ndarray, np.ndarray]:
        """Harmonics in the order of their columns, and how many columns each has."""
        order = self.waves.order
        begins = np.flatnonzero(np.r_[True, order[1:] != order[:-1]])
        return order[begins].astype(int), np.diff(np.r_[begins, len(order)])
