"""First-order signatures: what a small change does to modes, without solving again."""

from __future__ import annotations

import numpy as np

from statorhom.model.broken.basis import SymmetricBasis
from statorhom.model.broken.change import Attachment, Change
from statorhom.model.broken.coupling import piece_matrices
from statorhom.model.broken.grams import project
from statorhom.model.broken.solve import BrokenModes


def projected(basis: SymmetricBasis, change: Change) -> tuple[np.ndarray, np.ndarray]:
    """δK and δM (n, n) between the coordinates of a basis: the cosine families of its columns, then the sine ones.

    A doublet's complex split is z_cc - z_ss + 2 i z_cs with z = δK - λ δM; what couples two orders are the entries
    between them. `SymmetricBasis.truncated` keeps the basis to the modes of a band.
    """
    waves = basis.waves
    if isinstance(change, Attachment):
        rows = change.rows @ waves.at_points(change.points)
        return rows.T @ change.stiffness @ rows, rows.T @ change.mass @ rows
    parts = [
        np.zeros((len(waves), len(waves)))
        if part is None
        else project(basis.grams, part, change.weights, waves, waves)
        for part in (change.stiffness, change.mass)
    ]
    return parts[0], parts[1]


def slopes(modes: BrokenModes, change: Change) -> np.ndarray:
    """Derivatives (modes,) of the eigenvalues along a change: ∂λ/∂p = xᵀ(δK - λ δM)x.

    Of modes that share an eigenvalue they are those of the shapes as they were found.
    """
    total = np.zeros(len(modes))
    if isinstance(change, Attachment):
        motion = modes.shapes.motion(change.points).reshape(-1, len(modes))
        u = change.rows @ motion
        return np.asarray(
            np.sum(u * (change.stiffness @ u) - modes.eigenvalues * u * (change.mass @ u), axis=0)
        )
    for part, factor in ((change.stiffness, np.ones(len(modes))), (change.mass, -modes.eigenvalues)):
        if part is not None:
            inner, _ = piece_matrices(modes.basis, modes.coupled.statics, part, change.weights)
            total += factor * np.sum(modes.coordinates * (inner @ modes.coordinates), axis=0)
    return total
