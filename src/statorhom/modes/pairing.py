"""Pairing of measured with simulated modes, leaving modes unpaired on both sides where need be."""

from __future__ import annotations

import heapq
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import numpy.typing as npt
from scipy.optimize import linear_sum_assignment

from statorhom.modes.mode_protocols import LabelledMode, SimulatedMode
from statorhom.modes.pairing_cost import UNPAIRED, FloatArray, PairingCost, pairing_cost

DOUBLET_SPLIT = 0.05  # of ln f: as far as two lines of one doublet usually lie apart
MOST = 500  # assignments that are compared before the cheaper of two ways is followed alone


class Pair(NamedTuple):
    """A measured and a simulated mode by their positions, and the doubt (0 … 0.5) about it."""

    measured: int
    simulated: int
    doubt: float


@dataclass(frozen=True)
class Pairing:
    """Which measured mode is which simulated one.

    Attributes
    ----------
    pairs : tuple of Pair
        In the order of the measured modes; the two modes of a doublet name the same simulated one.
    unpaired_measured, unpaired_simulated : tuple of int
        Positions of the modes that belong to none.
    """

    pairs: tuple[Pair, ...]
    unpaired_measured: tuple[int, ...]
    unpaired_simulated: tuple[int, ...]


def pair(
    measured: Sequence[LabelledMode],
    simulated: Sequence[SimulatedMode],
    log_sd: float | npt.ArrayLike,
    *,
    gate: float = 4.0,
    labelled_gate: float = 12.0,
    doublet_split: float = DOUBLET_SPLIT,
    with_doubt: bool = True,
    also: Sequence[Sequence[int | None]] = (),
) -> Pairing:
    """Pair modes so that the sum of the costs is the least (an optimal assignment).

    A pair costs ((ln f_measured − ln f_simulated) / log_sd)² − 2 ln visibility, which is −2 ln of its
    likelihood; a measured mode that stays unpaired costs its gate squared. A label (order, axial) that
    the measured mode has must be the simulated one's. A doublet (multiplicity 2) can take two measured
    modes that lie within `doublet_split` of each other. The doubt of a pair is 1 / (1 + exp(Δ/2)), Δ
    what the best assignment without that pair costs more: 0.5 where another explanation is as good.

    Parameters
    ----------
    measured : sequence of LabelledMode
    simulated : sequence of SimulatedMode
        Modes at zero frequency or of zero visibility pair with nothing.
    log_sd : float or array_like, shape (measured,)
        Standard deviation of ln f_measured − ln f_simulated that is expected (0.05: five percent).
    gate, labelled_gate : float
        Greatest distance in `log_sd` at which a mode without and with labels is paired.
    doublet_split : float
        Greatest difference of the logarithms of a doublet's two frequencies.
    with_doubt : bool
        False saves most of the time; the doubts are then NaN.
    also : sequence of sequences of int
        Other counts of node planes that a simulated mode may be called by, one sequence for each mode; empty where
        none has any. Both modes of a doublet are called alike.

    Raises
    ------
    ValueError
        When a measured frequency, `log_sd` or a gate is not finite and positive.
    """
    cost = pairing_cost(
        measured,
        simulated,
        log_sd,
        gate=gate,
        labelled_gate=labelled_gate,
        doublet_split=doublet_split,
        also=also,
    )
    best, total = _assign(cost)
    doubts = _doubts(cost, best, total) if with_doubt else np.full(len(best), np.nan)
    paired = np.flatnonzero(best != UNPAIRED).tolist()
    taken = set(best.tolist())
    return Pairing(
        tuple(Pair(i, int(best[i]), float(doubts[i])) for i in paired),
        tuple(np.flatnonzero(best == UNPAIRED).tolist()),
        tuple(j for j in range(len(simulated)) if j not in taken),
    )


class _Node(NamedTuple):
    """An assignment with some pairs forbidden; the number decides between equals."""

    total: float
    number: int
    best: npt.NDArray[np.int64]
    cost: PairingCost


def _assign(cost: PairingCost) -> tuple[npt.NDArray[np.int64], float]:
    """Simulated mode of every measured one (−1: none) and the total cost.

    An assignment cannot say "both or neither": of two modes that are no doublet either the first keeps it, and what is
    far from it does not, or it gives it up. Branch and bound, the cheapest node first, for what is forbidden makes
    nothing cheaper.
    """
    waiting, made = [_node(cost, 0)], 1
    while True:
        node = heapq.heappop(waiting)
        conflict = next(_conflicts(node.best, node.cost.close), None)
        if conflict is None:
            return node.best, node.total
        i, j = conflict[0], int(node.best[conflict[0]])
        children = [_node(node.cost.keeping(i, j), made), _node(node.cost.without(i, j), made + 1)]
        made += len(children)
        if made > MOST:
            waiting, children = [], [min(children)]
        for child in children:
            heapq.heappush(waiting, child)


def _node(cost: PairingCost, number: int) -> _Node:
    rows, columns = linear_sum_assignment(cost.table)
    return _Node(float(cost.table[rows, columns].sum()), number, cost.owner[columns], cost)


def _conflicts(best: npt.NDArray[np.int64], close: npt.NDArray[np.bool_]) -> Iterator[tuple[int, int]]:
    """Measured modes that share a simulated one although they lie too far apart for a doublet."""
    seen: dict[int, int] = {}
    for i, j in enumerate(best.tolist()):
        if j == UNPAIRED:
            continue
        if j in seen and not close[seen[j], i]:
            yield seen[j], i
        seen[j] = i


def _doubts(cost: PairingCost, best: npt.NDArray[np.int64], total: float) -> FloatArray:
    doubts = np.full(len(best), np.nan)
    for i in np.flatnonzero(best != UNPAIRED).tolist():
        _, alternative = _assign(cost.without(i, int(best[i])))
        excess = max(alternative - total, 0.0)
        doubts[i] = np.exp(-0.5 * excess) / (1.0 + np.exp(-0.5 * excess))
    return doubts
