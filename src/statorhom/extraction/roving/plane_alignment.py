"""The same mode in every plane: by its frequency, and by the circumferential order that it has there.

Where modes lie close the fits of two planes may have begun at poles of different ones.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
from scipy.optimize import linear_sum_assignment

from statorhom.extraction.roving.plane_poles import PlanePoles
from statorhom.extraction.roving.rings import Rings
from statorhom.extraction.roving.wave import order_energies

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int_]

_FAR = 5.0  # half-power bandwidths from which on distance tells nothing more
_UNLIKE = 5.0  # half-power bandwidths that another order counts as much as
_LARGEST_MOVE = 2.0  # half-power bandwidths: what passes other modes by more is not one mode


def aligned(found: PlanePoles, rings: Rings) -> PlanePoles:
    """With the modes of every plane in the order of those of the plane that is explained best.

    What would have to pass other modes by more than a sensor moves any is several modes, and left out.
    """
    first = int(np.argmin(found.misfit.mean(axis=1)))
    shares = _order_shares(found, rings)
    poles, residues, misfit = found.poles.copy(), found.residues.copy(), found.misfit.copy()
    for z, rows in enumerate(rings.members):
        taken = _partners(found.poles[first], found.poles[z], shares[first] @ shares[z].T)
        poles[z], misfit[z] = found.poles[z, taken], found.misfit[z, taken]
        residues[rows] = found.residues[rows][..., taken]
    kept = _kept(poles)
    return PlanePoles(poles[:, kept], residues[..., kept], misfit[:, kept])


def _kept(poles: np.ndarray) -> IntArray:
    """Numbers of the modes without those that pass others from afar."""
    kept = np.arange(poles.shape[1])
    width = np.median(poles.imag / poles.real)
    while len(kept):
        rank = np.argsort(np.argsort(poles.real[:, kept], axis=1), axis=1)
        moved = 0.5 * np.ptp(np.log(poles.real[:, kept]), axis=0) * (np.ptp(rank, axis=0) > 0)
        worst = int(np.argmax(moved))
        if moved[worst] <= _LARGEST_MOVE * width:
            break
        kept = np.delete(kept, worst)
    return kept


def _order_shares(found: PlanePoles, rings: Rings) -> FloatArray:
    """Roots of the orders' parts of every mode's energy, shape (planes, modes, orders)."""
    count = found.poles.shape[1]
    energy = np.array([order_energies(found.residues[..., m], rings) for m in range(count)]).swapaxes(0, 1)
    whole = np.maximum(energy.sum(axis=2, keepdims=True), np.finfo(float).tiny)
    return np.asarray(np.sqrt(energy / whole))


def _partners(ours: np.ndarray, theirs: np.ndarray, alike: FloatArray) -> IntArray:
    """For each of our poles the number of theirs; `alike` are the orders' common parts, shape (ours, theirs)."""
    apart = np.abs(ours.real[:, None] - theirs.real) / ours.imag[:, None]
    cost = np.minimum(apart, _FAR) + _UNLIKE * (1 - alike)
    return np.asarray(linear_sum_assignment(cost)[1])
