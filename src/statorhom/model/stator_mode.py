"""A simulated mode of the tested object, with its name."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from statorhom.model.eigen import frequency_hz

RIGID_HZ = 1.0  # a free stator's rigid-body modes, which rounding moves off zero
# Part of a uniform ring's radial motion below which an accelerometer on the back of the core sees no order.
VISIBLE = 1e-3


class StatorMode(NamedTuple):
    """One simulated mode; a doublet is one mode of multiplicity 2.

    A tuple, for an evaluation of a tenth of a millisecond names a hundred of them.

    Parameters
    ----------
    frequency_hz : undamped natural frequency.
    order, axial : the name (r, n); None where the surface has no significant radial motion.
    kind : "radial" or "winding" (or "torsion", "axial": see `kind_of`); "" of a body that is no stator.
    visibility : mean square radial order-r motion of the surface times the stator's mass over the modal mass, cut at 1.
    multiplicity : 2 for a doublet.
    problem : number of the harmonic problem in its solver's list.
    column : number of the mode in that problem.
    parities : number of the combination of parities of a body with mirror planes; None for a stator.
    """

    frequency_hz: float
    order: int | None
    axial: int | None
    kind: str
    visibility: float
    multiplicity: int
    problem: int
    column: int
    parities: int | None = None

    @property
    def place(self) -> tuple[int, int]:
        """Problem and column: modes of one problem avoid crossings, so that a place is followed continuously."""
        return self.problem, self.column

    @property
    def family(self) -> tuple[int, int] | None:
        """Modes of one family never mix with others: (r, n) of a stator, (parities, 0) of a body with mirror planes.

        None where a stator's surface has no significant radial motion.
        """
        if self.parities is not None:
            return self.parities, 0
        return None if self.order is None or self.axial is None else (self.order, self.axial)


def name_modes(
    eigenvalues: np.ndarray,
    amplitudes: np.ndarray,
    axial: np.ndarray,
    *,
    order: Sequence[int],
    multiplicity: Sequence[int],
    mass: float,
    problem: Sequence[int],
    column: Sequence[int],
) -> list[StatorMode]:
    """Modes of any harmonic problems, rigid bodies left out.

    Parameters
    ----------
    eigenvalues : (k,) rad²/s².
    amplitudes : (p, k) radial order amplitudes of shapes of unit modal mass, in planes over the core.
    axial : (k,) node planes.
    order, multiplicity, problem : of the harmonic problem of each mode.
    mass : of the stator (kg).
    column : of each mode in its problem.
    """
    visibility = np.minimum(1.0, mass * np.mean(amplitudes**2, axis=0))
    columns = (frequency_hz(eigenvalues).tolist(), order, axial.tolist(), visibility.tolist(), multiplicity)
    return [
        StatorMode(f, r, n, "radial", seen, several, number, place)
        if seen > VISIBLE
        else StatorMode(f, None, None, "winding", seen, several, number, place)
        for f, r, n, seen, several, number, place in zip(*columns, problem, column, strict=True)
        if f >= RIGID_HZ
    ]


def modes_of_parities(
    eigenvalues: np.ndarray,
    amplitudes: np.ndarray,
    *,
    parities: Sequence[int],
    mass: float,
    problem: Sequence[int],
    column: Sequence[int],
) -> list[StatorMode]:
    """Modes of a body with mirror planes, rigid bodies left out; see `name_modes`.

    Parameters
    ----------
    amplitudes : (p, k) normal motion of shapes of unit modal mass at points of the faces.
    parities : numbers of the combinations.
    """
    visibility = np.minimum(1.0, mass * np.mean(amplitudes**2, axis=0)).tolist()
    return [
        StatorMode(f, None, None, "", visibility[i], 1, problem[i], column[i], parities[i])
        for i, f in enumerate(frequency_hz(eigenvalues).tolist())
        if f >= RIGID_HZ
    ]
