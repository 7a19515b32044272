"""Start poles of every measuring plane by itself: inside a plane a sensor moves all FRFs of a doublet alike.

Where modes are dense, those of all planes together look like more or fewer than there are.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt
from scipy.optimize import linear_sum_assignment

from statorhom.extraction.mode_search import ModeSearch
from statorhom.extraction.roving.rings import Rings
from statorhom.extraction.stabilization import LEAST_SHARE, stabilize

ComplexArray = npt.NDArray[np.complex128]
IntArray = npt.NDArray[np.int_]

BROAD = 0.03
"""Loss factor of what is no resonance of its own."""

_REACH = 2.0  # half-power bandwidths: the same mode in another plane
_SHOWN = 0.5  # of the planes, at least; that the whole recording shows a mode counts like a plane


def plane_starts(search: ModeSearch, rings: Rings) -> ComplexArray:
    """A pole of every mode in every plane, in ascending frequency, shape (planes, modes).

    Where a plane does not show a mode, the mean of the others stands for it. In units of the search.
    """
    members = rings.members
    table = _matched([_stable(search, rows) for rows in members])
    mean = np.nanmean(table, axis=0) if table.size else np.zeros(0, dtype=complex)
    # all planes together show a mode that moves as several: they confirm those that stand alone, and add none
    confirmed = (_near(search.stable[_is_narrow(search.stable)], mean) > 0) & (_near(mean, mean) == 1)
    kept = np.isfinite(table).sum(axis=0) + confirmed >= _SHOWN * len(members)
    filled: ComplexArray = np.where(np.isfinite(table), table, mean).astype(complex)[:, kept]
    return filled[:, np.argsort(filled.real.mean(axis=0))]


def _near(poles: ComplexArray, places: ComplexArray) -> IntArray:
    """Number of poles around each of some places."""
    return np.asarray(np.sum(np.abs(poles.real[:, None] - places.real) < _REACH * places.imag, axis=0))


def _is_narrow(poles: ComplexArray) -> npt.NDArray[np.bool_]:
    return (poles.imag > 0) & (poles.imag < BROAD * poles.real)


def _stable(search: ModeSearch, rows: IntArray) -> ComplexArray:
    """Of some points, in ascending frequency."""
    poles, _, diagram = stabilize(search.grid.at(rows.tolist()), search.sd[rows])
    lasting = [diagram.share(pole) >= LEAST_SHARE for pole in poles.tolist()]
    chosen = poles[_is_narrow(poles) & np.array(lasting, dtype=bool)]
    return np.asarray(chosen[np.argsort(chosen.real)] / search.unit)


def _matched(planes: Sequence[ComplexArray]) -> ComplexArray:
    """Every plane's poles beside those of the plane that shows most, NaN where it has none there."""
    most = max(planes, key=len)
    table = np.full((len(planes), len(most)), np.nan, dtype=complex)
    for row, poles in zip(table, planes, strict=True):
        apart = np.abs(poles.real[:, None] - most.real) / most.imag
        for i, j in zip(*linear_sum_assignment(np.minimum(apart, _REACH)), strict=True):
            if apart[i, j] < _REACH:
                row[j] = poles[i]
    return table
