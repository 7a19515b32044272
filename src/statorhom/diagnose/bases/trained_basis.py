"""The broken basis with the local fields of some changes, and where the named modes stand in it.

Stiffness that varies deforms the stator where its symmetric modes are smooth, and along the axis it couples modes far
apart. One static response to every example's residual holds most of that; it is made once for all places and strengths.
"""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from statorhom.model.broken.basis import SymmetricBasis
from statorhom.model.broken.change import Change
from statorhom.model.broken.enrich import enriched
from statorhom.model.broken.named_response import Columns, columns_of
from statorhom.model.broken.solve import solve_broken
from statorhom.model.convergence import ModeKey
from statorhom.model.harmonic import Harmonic

Examples = Sequence[Sequence[Change]]  # changes at once, one example after the other

LEAST = 3e-5  # relative frequency error below which a direction is left out
# the same of an explanation's own changes: a deep soft strip has hundreds of directions above the other one, and what
# each solution takes grows with the cube of them
OWN_LEAST, COARSER, OWN_MOST = 1e-4, 2.0, 220
ALL_LEAST, ROUNDS = 1e-5, 2  # of what is solved once
OWN = 0.3  # share of the named modes from which on a mode is theirs


@dataclass(frozen=True, eq=False)
class TrainedBasis:
    """A basis of all harmonics.

    Parameters
    ----------
    basis : of the symmetric stator.
    columns : places of the named modes.
    amplitudes : what is kept of the motion that its coordinates make (`statorhom.diagnose.stages.order_profiles`).
    """

    basis: SymmetricBasis
    columns: Mapping[ModeKey, Columns]
    amplitudes: dict[Hashable, Any] = field(default_factory=dict, repr=False)

    def corrected(self, factors: Mapping[ModeKey, float]) -> TrainedBasis:
        """With the named modes' frequencies multiplied by mesh factors.

        How far two modes mix is told by how far they are from each other, which a coarse mesh gets wrong.
        """
        squares = {i: factors[key] ** 2 for key, c in self.columns.items() for i in c.numbers}
        basis = self.basis.with_values(squares)
        columns = {
            key: replace(c, eigenvalue=c.eigenvalue * factors[key] ** 2) for key, c in self.columns.items()
        }
        # the same vectors move alike
        return TrainedBasis(basis, columns, self.amplitudes)

    def trained(
        self,
        examples: Examples,
        named: Mapping[ModeKey, tuple[Harmonic, float]],
        least: float = LEAST,
    ) -> TrainedBasis:
        """With the responses of the named modes to some changes.

        Parameters
        ----------
        examples : what to hold.
        named : problem and frequency (Hz) of the named modes.
        least : relative frequency error below which a direction is left out.
        """
        found = self
        for changes in examples:
            modes = solve_broken(found.basis, changes, tolerance=None)
            rows = [i for c in found.columns.values() for i in c.numbers]
            used = np.sum(modes.participation[rows] ** 2, axis=0) > OWN
            values, x = modes.eigenvalues[used], modes.coordinates[:, used]
            found = trained_basis(enriched(found.basis, modes.coupled, values, x, least), named)
        return found

    def with_own(self, examples: Examples, named: Mapping[ModeKey, tuple[Harmonic, float]]) -> TrainedBasis:
        """With the responses to what an explanation changes, as many of the largest as are worth their time.

        Parameters
        ----------
        examples, named : as for `trained`.
        """
        least, size = OWN_LEAST, len(self.basis.values) + OWN_MOST
        found = self.trained(examples, named, least)
        while len(found.basis.values) > size:
            least *= COARSER
            found = self.trained(examples, named, least)
        return found

    def with_all(self, examples: Examples, named: Mapping[ModeKey, tuple[Harmonic, float]]) -> TrainedBasis:
        """With nearly all that a few examples ask for, in two rounds: the first one does not see what it leaves.

        A solution takes ten times as long as one of `with_own`, and is ten times as exact.
        """
        found = self
        for _ in range(ROUNDS):
            found = found.trained(examples, named, ALL_LEAST)
        return found


def trained_basis(basis: SymmetricBasis, named: Mapping[ModeKey, tuple[Harmonic, float]]) -> TrainedBasis:
    """A basis as it is; modes of problems that it lacks are left out."""
    places = {key: columns_of(basis, *place) for key, place in named.items()}
    return TrainedBasis(basis, {key: place for key, place in places.items() if place is not None})
