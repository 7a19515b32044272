"""What changed pieces make of a few motions of all copies.

Projected harmonic by harmonic, pieces couple every wave of a motion with every other one. Of a few motions the forces
on all copies are cheaper: they are summed up in the copies, and a row's wave then takes their work in its own harmonic
alone.
"""

from __future__ import annotations

from collections import OrderedDict
from dataclasses import dataclass, field

import numpy as np

from statorhom.model.broken.pieces import Pieces, weighted_alike
from statorhom.model.broken.waves import Waves

KEPT_BYTES = 2**27  # of the images of one set of motions


@dataclass(frozen=True, eq=False)
class MovedCopies:
    """Motions of the whole stator, and the forces of pieces that were asked for lately.

    Parameters
    ----------
    columns : waves that the motions are made of.
    coordinates : (len(columns), a) of each motion.
    """

    columns: Waves
    coordinates: np.ndarray
    _known: OrderedDict[tuple[int, bytes], tuple[Pieces, np.ndarray, np.ndarray]] = field(
        default_factory=OrderedDict, init=False, repr=False
    )

    def forces(self, pieces: Pieces, weights: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Displacements (d,) that weighted pieces act on, and their forces (2 N, d, a) on these in every half pitch.

        Parameters
        ----------
        weights : (e, 2 N) per piece and half pitch.
        """
        dofs = np.unique(pieces.dofs[np.any(weights != 0.0, axis=1)])
        total = np.zeros((weights.shape[1], len(dofs), self.coordinates.shape[1]))
        for group, pattern in weighted_alike(weights):
            own, images = self._images(pieces, group)
            total[:, np.searchsorted(dofs, own)] += pattern[:, None, None] * images
        return dofs, total

    def _images(self, pieces: Pieces, group: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Displacements (d,) of a group of pieces, and their forces (2 N, d, a) at a weight of one."""
        key = id(pieces), group.tobytes()
        if key not in self._known:
            # the pieces are kept too, so that their id stays theirs
            self._known[key] = (pieces, *self._made(pieces.take(group)))
        _, dofs, images = self._known[key]
        while sum(each.nbytes for _, _, each in self._known.values()) > KEPT_BYTES and len(self._known) > 1:
            self._known.popitem(last=False)
        return dofs, images

    def _made(self, pieces: Pieces) -> tuple[np.ndarray, np.ndarray]:
        dofs, part = pieces.alone()
        motion = self.columns.in_copies(dofs, self.coordinates)
        side_by_side = np.ascontiguousarray(np.moveaxis(motion, 1, 0)).reshape(len(dofs), -1)
        images = part.matrix(np.ones(len(part))) @ side_by_side
        return dofs, np.moveaxis(images.reshape(len(dofs), len(motion), -1), 0, 1)
