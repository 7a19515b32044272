"""Cost of every possible pair of a measured with a simulated mode."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from operator import attrgetter

import numpy as np
import numpy.typing as npt

from statorhom.modes.mode_protocols import LabelledMode, SimulatedMode

FloatArray = npt.NDArray[np.float64]

# A doublet that the measurement resolved is about as frequent as one that it did not: −2 ln ½.
SECOND_OF_DOUBLET_COST = float(2.0 * np.log(2.0))

UNPAIRED = -1
_UNKNOWN, _NO_ORDER = -1, -2
_measured_keys = attrgetter("frequency_hz", "order", "axial")
_simulated_keys = attrgetter("frequency_hz", "order", "axial", "kind", "visibility", "multiplicity")


@dataclass(frozen=True)
class PairingCost:
    """Table of an assignment problem, costs on the scale of −2 ln likelihood.

    Attributes
    ----------
    table : ndarray, shape (measured, columns)
        Cost of giving a measured mode a column; inf where that is impossible.
    owner : ndarray of int, shape (columns,)
        The simulated mode that a column stands for (a doublet may own two); −1: stays unpaired.
    close : ndarray of bool, shape (measured, measured)
        Whether two measured modes are close enough to be one doublet.
    """

    table: FloatArray
    owner: npt.NDArray[np.int64]
    close: npt.NDArray[np.bool_]

    def without(self, measured: int, simulated: int) -> PairingCost:
        """The same table with one pair made impossible."""
        table = self.table.copy()
        table[measured, self.owner == simulated] = np.inf
        return PairingCost(table, self.owner, self.close)

    def keeping(self, measured: int, simulated: int) -> PairingCost:
        """The same table with one pair made certain: what is no doublet with the measured mode has another partner."""
        table, its = self.table.copy(), self.owner == simulated
        table[measured, ~its] = np.inf
        others = ~self.close[measured]
        others[measured] = False
        table[np.ix_(others, its)] = np.inf
        return PairingCost(table, self.owner, self.close)


def pairing_cost(
    measured: Sequence[LabelledMode],
    simulated: Sequence[SimulatedMode],
    log_sd: float | npt.ArrayLike,
    *,
    gate: float,
    labelled_gate: float,
    doublet_split: float,
    also: Sequence[Sequence[int | None]] = (),
) -> PairingCost:
    """Costs ((ln f_measured − ln f_simulated) / log_sd)² − 2 ln visibility of the pairs whose labels agree.

    The parameters are those of `statorhom.modes.pairing.pair`.
    """
    frequency, order, axial = _measured_arrays(measured)
    sd = _checked_sd(log_sd, len(measured))
    log_measured = np.log(frequency)
    labelled = (order != _UNKNOWN) | (axial != _UNKNOWN)
    unpaired = np.where(labelled, _checked_gate(labelled_gate), _checked_gate(gate)) ** 2

    modes = _SimulatedArrays.of(simulated)
    cost = ((log_measured[:, None] - modes.log_frequency) / sd[:, None]) ** 2 + modes.visibility_cost
    allowed = (
        ((order[:, None] == modes.order) | (order[:, None] == _UNKNOWN))
        & (_called(axial, modes.axial, also) | (axial[:, None] == _UNKNOWN))
        & (modes.radial | ~labelled[:, None])
        & (cost < unpaired[:, None])
    )
    alike = (axial[:, None] == axial) | (axial[:, None] == _UNKNOWN) | (axial == _UNKNOWN)
    close = alike & (np.abs(log_measured[:, None] - log_measured) <= doublet_split)
    np.fill_diagonal(close, False)
    second = allowed & (close @ allowed) & modes.doublet
    return _table(np.where(allowed, cost, np.inf), second, unpaired, close)


def _called(
    measured: npt.NDArray[np.int64], own: npt.NDArray[np.int64], also: Sequence[Sequence[int | None]]
) -> npt.NDArray[np.bool_]:
    """Whether a simulated mode may be called by a measured count of node planes, shape (measured, simulated)."""
    called = measured[:, None] == own
    for j, counts in enumerate(also):
        if counts:
            called[:, j] |= np.isin(measured, _labels(counts, _NO_ORDER))
    return np.asarray(called)


def _table(
    cost: FloatArray, second: npt.NDArray[np.bool_], unpaired: FloatArray, close: npt.NDArray[np.bool_]
) -> PairingCost:
    # only columns that somebody can take, because the assignment's time grows with them
    once = np.flatnonzero((cost < np.inf).any(axis=0))
    twice = np.flatnonzero(second.any(axis=0))
    again = np.where(second, cost + SECOND_OF_DOUBLET_COST, np.inf)[:, twice]
    count = len(unpaired)
    alone = np.broadcast_to(unpaired[:, None], (count, count))
    owner = np.concatenate([once, twice, np.full(count, UNPAIRED)])
    return PairingCost(np.concatenate([cost[:, once], again, alone], axis=1), owner, close)


@dataclass(frozen=True)
class _SimulatedArrays:
    log_frequency: FloatArray
    order: npt.NDArray[np.int64]
    axial: npt.NDArray[np.int64]
    radial: npt.NDArray[np.bool_]
    visibility_cost: FloatArray
    doublet: npt.NDArray[np.bool_]

    @classmethod
    def of(cls, simulated: Sequence[SimulatedMode]) -> _SimulatedArrays:
        keys = [_simulated_keys(mode) for mode in simulated]
        frequency, order, axial, kind, visibility, multiplicity = (
            zip(*keys, strict=True) if keys else [()] * 6
        )
        return cls(
            # rigid-body modes have no logarithm and pair with nothing
            _log_or(np.array(frequency, dtype=float), -np.inf),
            _labels(order, _NO_ORDER),
            _labels(axial, _NO_ORDER),
            np.array([one == "radial" for one in kind], dtype=bool),
            -2.0 * _log_or(np.array(visibility, dtype=float), -np.inf),
            np.array(multiplicity, dtype=int) >= 2,
        )


def _measured_arrays(
    measured: Sequence[LabelledMode],
) -> tuple[FloatArray, npt.NDArray[np.int64], npt.NDArray[np.int64]]:
    keys = [_measured_keys(mode) for mode in measured]
    frequency, order, axial = zip(*keys, strict=True) if keys else [()] * 3
    values = np.array(frequency, dtype=float)
    if not (np.isfinite(values) & (values > 0.0)).all():
        raise ValueError("measured frequencies must be finite and positive")
    return values, _labels(order, _UNKNOWN), _labels(axial, _UNKNOWN)


def _labels(values: Sequence[int | None], missing: int) -> npt.NDArray[np.int64]:
    return np.array([missing if value is None else value for value in values], dtype=np.int64)


def _log_or(values: FloatArray, otherwise: float) -> FloatArray:
    return np.log(values, where=values > 0.0, out=np.full(values.shape, otherwise))


def _checked_sd(log_sd: float | npt.ArrayLike, count: int) -> FloatArray:
    sd = np.asarray(log_sd, dtype=float)
    if not (np.isfinite(sd) & (sd > 0.0)).all():
        raise ValueError("log_sd must be finite and positive")
    return np.broadcast_to(sd, (count,))


def _checked_gate(gate: float) -> float:
    if not (np.isfinite(gate) and gate > 0.0):
        raise ValueError("a gate must be finite and positive")
    return gate
