"""The whole stator's flexibility between held points, summed over its harmonics."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from statorhom.model.point_response import LocalPoints, PointResponse


def flexibility(points: LocalPoints, responses: Sequence[PointResponse]) -> tuple[np.ndarray, np.ndarray]:
    """Flexibility L (K + σ M)⁻¹ Lᵀ of held points, and the mass products of the static responses.

    The two families of a harmonic together give Re ℓ_i P Re ℓ_jᵀ + Im ℓ_i P Im ℓ_jᵀ = Re ℓ_i P ℓ_jᴴ: of the
    pitches of two points only the difference enters.

    Returns
    -------
    flexibility, inertia : (3 p, 3 p) each.
    """
    totals = np.zeros((2, len(points), len(points)))
    count = points.matrix.shape[0]
    place = points.row + np.where(points.side < 0, count, 0)
    for order in sorted({r.harmonic.order for r in responses}):
        phase = points.phase(order)
        for number, name in enumerate(("flexibility", "inertia")):
            local = sum(getattr(r, name) for r in responses if r.harmonic.order == order)
            between = _both_sides(np.asarray(local), count)[np.ix_(place, place)]
            totals[number] += np.real(phase[:, None] * between * phase.conj())
    return totals[0], totals[1]


def _both_sides(local: np.ndarray, count: int) -> np.ndarray:
    """Products (A ± i B) P (A ± i B)ᴴ for the upper sign and, behind it, for the lower one."""
    one = np.eye(count)
    turn = np.block([[one, 1j * one], [one, -1j * one]])
    return np.asarray(turn @ local @ turn.conj().T)
