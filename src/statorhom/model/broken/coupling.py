"""Stiffness and mass of the broken stator in the basis of waves and static responses, and its residuals' probes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from statorhom.model.broken.basis import SymmetricBasis
from statorhom.model.broken.change import Attachment, Change, PieceChange
from statorhom.model.broken.grams import projections
from statorhom.model.broken.pieces import Pieces
from statorhom.model.broken.statics import Statics, statics


@dataclass(frozen=True, eq=False)
class Coupled:
    """The broken stator in coordinates x = (q, f): of the basis W, then of the static responses Y.

    Parameters
    ----------
    statics : of the attachments.
    pieces : changes of pieces.
    K, M : (n, n).
    probe_stiffness, probe_mass : (probes, n) of ζᵀK and ζᵀM.
    """

    statics: Statics
    pieces: tuple[PieceChange, ...]
    K: np.ndarray
    M: np.ndarray
    probe_stiffness: np.ndarray
    probe_mass: np.ndarray


def couple(basis: SymmetricBasis, changes: Sequence[Change]) -> Coupled:
    """Assemble what the changes couple."""
    own = statics(basis, [c for c in changes if isinstance(c, Attachment)])
    pieces = tuple(c for c in changes if isinstance(c, PieceChange))
    sigma, known = basis.shift, own.answers
    rows, products, G, H = known.rows, known.products, known.flexibility, known.inertia
    mixed = rows.T - sigma * products
    still = G - sigma * H
    values = basis.values
    if basis.added is not None:
        values = values + basis.added
        mixed = mixed + basis.added[:, None] * products
        still = still + products.T @ (basis.added[:, None] * products)
    K = np.block([[np.diag(values), mixed], [mixed.T, still]])
    M = np.block([[np.eye(len(basis.values)), products], [products.T, H]])
    (zK, zM), (zL, zY) = basis.probed, known.probed
    probe_stiffness, probe_mass = np.hstack([zK, zL - sigma * zY]), np.hstack([zM, zY])
    motion = known.motion
    K += motion.T @ own.stiffness @ motion
    M += motion.T @ own.mass @ motion
    probe_stiffness += zL @ (own.stiffness @ motion)
    probe_mass += zL @ (own.mass @ motion)
    for change in pieces:
        for total, probed, part in ((K, probe_stiffness, change.stiffness), (M, probe_mass, change.mass)):
            if part is not None:
                inner, outer = piece_matrices(basis, own, part, change.weights)
                total += inner
                probed += outer
    return Coupled(own, pieces, K, M, probe_stiffness, probe_mass)


def piece_matrices(
    basis: SymmetricBasis, own: Statics, part: Pieces, weights: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Weighted pieces between all coordinates (n, n), and between the probes and them."""
    waves, probes = basis.waves, basis.probes
    inner, outer = projections(basis.grams, part, weights, [waves, probes], waves)
    if len(own):
        (mixed, probed), still = own.to_units.projected(part, weights, [waves, probes])
        inner = np.block([[inner, mixed], [mixed.T, still]])
        outer = np.hstack([outer, probed])
    return (inner + inner.T) / 2, outer
