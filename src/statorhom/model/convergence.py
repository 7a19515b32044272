"""The mesh's own error: the same modes on refined meshes, extrapolated to infinitely fine ones."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from statorhom.model.free_modes import FreeModes
from statorhom.model.stator_mode import StatorMode

# Re-entrant corners bound the order of convergence of frequencies from below, smooth solutions from above.
ORDERS = (1.2, 3.0)
# of ln f from mesh to mesh; beyond them, it is another mode. A finer mesh is softer, but for what it sees better of the
# shape of the body.
LARGEST_FALL, LARGEST_RISE = 0.07, 0.005
USUAL_STEP, USUAL_CHANGE = 0.03, 0.3  # of ln f and of the logarithm of the visibility, of one mode
UNSEEN = 1e-9  # visibility that is none
USUAL_ORDER = 2.3  # of graded meshes of slotted cores (measured on the 36-slot machine)

ModeKey = tuple[int, int, int]


@dataclass(frozen=True)
class ModeConvergence:
    """One mode on a series of meshes.

    Parameters
    ----------
    key : (order, axial, rank): rank counts modes of the same name from below.
    dof : degrees of freedom of the whole stator's meshes.
    frequency_hz : on these meshes.
    extrapolated_hz : on an infinitely fine one.
    sd : relative standard deviation of the extrapolation.
    doubt : relative distance on the finest mesh to the mode that has its place there among those of its problem; 0
        where that is itself. Modes that have changed places are mixed, and which is which is not sure.
    """

    key: ModeKey
    dof: tuple[int, ...]
    frequency_hz: tuple[float, ...]
    extrapolated_hz: float
    sd: float
    doubt: float = 0.0

    @property
    def factor(self) -> float:
        """Extrapolated over the coarsest mesh's frequency."""
        return self.extrapolated_hz / self.frequency_hz[0]


def mode_keys(modes: Iterable[StatorMode]) -> dict[ModeKey, StatorMode]:
    """Visible modes by their family (order, axial) and rank; modes must be sorted by frequency."""
    found: dict[ModeKey, StatorMode] = {}
    for mode in modes:
        if (family := mode.family) is None:
            continue
        rank = 0
        while (*family, rank) in found:
            rank += 1
        found[(*family, rank)] = mode
    return found


def converge(
    sizes: Sequence[float], dofs: Sequence[int], solutions: Sequence[FreeModes]
) -> tuple[ModeConvergence, ...]:
    """Extrapolate every mode that all meshes have.

    Parameters
    ----------
    sizes : relative element sizes, coarsest first (1, 1/1.5, …).
    dofs : of the whole stator's meshes.
    solutions : modes at the same materials.
    """
    tables = [mode_keys(solution.modes) for solution in solutions]
    series = {key: [mode] for key, mode in tables[0].items()}
    for table in tables[1:]:
        finer: dict[tuple[int, int], list[StatorMode]] = {}
        for key, mode in table.items():
            finer.setdefault(key[:2], []).append(mode)
        series = _continued(series, finer)
    finest = {mode.place: mode for mode in solutions[-1].modes}
    return tuple(_mode(key, sizes, dofs, modes, finest) for key, modes in series.items())


def _continued(
    series: Mapping[ModeKey, list[StatorMode]], finer: Mapping[tuple[int, int], Sequence[StatorMode]]
) -> dict[ModeKey, list[StatorMode]]:
    """Series with the modes of the next mesh, the likest of their names first; without those that are lost.

    Ranks would not do: a mode that hardly moves the surface may be visible on one mesh alone. Nor does frequency:
    teeth are so much softer on a finer mesh that one of their modes takes the place of another.
    """
    steps = [
        (_unlike(modes[-1], found), key, i)
        for key, modes in series.items()
        for i, found in enumerate(finer.get(key[:2], ()))
        if -LARGEST_FALL < np.log(found.frequency_hz / modes[-1].frequency_hz) < LARGEST_RISE
    ]
    partners: dict[ModeKey, int] = {}
    taken: set[tuple[int, int, int]] = set()
    for _, key, i in sorted(steps):
        if key not in partners and (*key[:2], i) not in taken:
            partners[key] = i
            taken.add((*key[:2], i))
    return {key: [*modes, finer[key[:2]][partners[key]]] for key, modes in series.items() if key in partners}


def _unlike(coarse: StatorMode, fine: StatorMode) -> float:
    """How little speaks for one mode: frequency, motion of the surface, place among the modes of its problem."""
    step = np.log(fine.frequency_hz / coarse.frequency_hz) / USUAL_STEP
    seen = np.log(max(fine.visibility, UNSEEN) / max(coarse.visibility, UNSEEN)) / USUAL_CHANGE
    return float(step**2 + seen**2 + (fine.column != coarse.column))


def _mode(
    key: ModeKey,
    sizes: Sequence[float],
    dofs: Sequence[int],
    modes: Sequence[StatorMode],
    finest: Mapping[tuple[int, int], StatorMode],
) -> ModeConvergence:
    frequencies = [m.frequency_hz for m in modes]
    limit, spread = extrapolate(np.asarray(sizes), np.asarray(frequencies))
    there = finest.get((modes[-1].problem, modes[0].column), modes[-1])
    doubt = abs(float(np.log(there.frequency_hz / modes[-1].frequency_hz)))
    return ModeConvergence(key, tuple(dofs), tuple(frequencies), limit, spread / limit, doubt)


def extrapolate(sizes: np.ndarray, frequencies: np.ndarray) -> tuple[float, float]:
    """Richardson extrapolation f = f₀ + C hᵖ to h = 0.

    Parameters
    ----------
    sizes : (k,) element sizes, descending.
    frequencies : (k,).

    Returns
    -------
    limit, sd : f₀ and half the distance to what the bounds of p would give.

    Notes
    -----
    With three meshes or more p comes from the data, within `ORDERS`; with two it is `USUAL_ORDER`.
    """
    if len(sizes) < 2:
        return float(frequencies[-1]), 0.01 * float(frequencies[-1])
    p = _observed_order(sizes, frequencies) if len(sizes) > 2 else USUAL_ORDER
    low, limit, high = (_limit(sizes, frequencies, q) for q in (ORDERS[0], p, ORDERS[1]))
    return limit, 0.5 * max(abs(limit - low), abs(limit - high), 0.1 * abs(limit - frequencies[-1]))


def _limit(sizes: np.ndarray, frequencies: np.ndarray, p: float) -> float:
    a, b = sizes[-2] ** p, sizes[-1] ** p
    return float((frequencies[-1] * a - frequencies[-2] * b) / (a - b))


def _observed_order(sizes: np.ndarray, frequencies: np.ndarray) -> float:
    f1, f2, f3 = frequencies[-3:]
    h1, h2, h3 = sizes[-3:]
    if (f1 - f2) * (f2 - f3) <= 0:
        return USUAL_ORDER  # not monotonic: the series tells no order
    trial = np.linspace(*ORDERS, 200)
    ratio = (h1**trial - h2**trial) / (h2**trial - h3**trial)
    return float(trial[np.argmin(np.abs(np.log(ratio) - np.log((f1 - f2) / (f2 - f3))))])
