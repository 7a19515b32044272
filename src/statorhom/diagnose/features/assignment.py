"""Which predicted mode every measured one is, by name and frequency."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import log

import numpy as np

from statorhom.diagnose.measured.measured_test import MeasuredTest
from statorhom.diagnose.predicted.prediction import PredictedMode
from statorhom.identify.residuals.stage_problem import GATE, LABELLED_GATE, PAIRING_SD
from statorhom.model.convergence import ModeKey
from statorhom.modes.pairing import DOUBLET_SPLIT, pair
from statorhom.study.modal_table import MeasuredMode

AS_FAR = 1.3  # of a predicted split: up to which two lines are its own
WIDEST = 0.1  # of ln f: two lines that alone bear one name are a doublet's up to here, whatever parts them
ROUNDING = 1e-9
# of the distance up to which modes are partners: that of partners where most modes agree already
NEAR = 0.2
PARTED = 0.01  # of ln f: from which on the lines of a doublet are looked for where each of them is predicted

Keys = tuple[ModeKey | None, ...]
Named = Mapping[tuple[int | None, int | None], Sequence[float]]


@dataclass(frozen=True, eq=False)
class Sought:
    """Measured modes and the predicted lines among which their partners are.

    Parameters
    ----------
    test, modes : the measurement, names corrected.
    lines : that a test may show of the predicted modes, by frequency.
    apart : of ln f, up to which two measured lines are one doublet's.
    """

    test: MeasuredTest
    modes: Sequence[MeasuredMode]
    lines: Sequence[_Line]
    apart: float

    def within(self, reach: float) -> Keys:
        """Named partner of every measured mode; `reach`: as a part of how far partners may usually lie apart."""
        used = [i for i, mode in enumerate(self.modes) if not (self.test.recorded and mode.order is None)]
        found = pair(
            [self.modes[i] for i in used],
            self.lines,
            reach * PAIRING_SD,
            gate=GATE,
            labelled_gate=LABELLED_GATE,
            doublet_split=self.apart,
            with_doubt=False,
            also=[line.counts[1:] for line in self.lines],
        )
        keys: list[ModeKey | None] = [None] * len(self.modes)
        for p in found.pairs:
            keys[used[p.measured]] = self.lines[p.simulated].key
        return tuple(keys)


def sought(
    test: MeasuredTest, modes: Sequence[MeasuredMode], predicted: Mapping[ModeKey, PredictedMode]
) -> Sought:
    """What partners are looked for among, at any reach."""
    lines = [line for mode in predicted.values() for line in _lines(mode)]
    # a heavy lump may part a doublet's lines by more than any scatter does
    apart = [
        DOUBLET_SPLIT,
        *(AS_FAR * abs(m.split) / 2 for m in predicted.values()),
        *_of_one_name(_by_name(modes)),
    ]
    return Sought(test, modes, tuple(sorted(lines, key=lambda line: line.frequency_hz)), max(apart))


@dataclass(frozen=True)
class _Line:
    """What a test may show of a predicted mode: both lines of a doublet, or one that lies far from the other.

    Parameters
    ----------
    mode : what it is of.
    counts : of node planes that it may be called by.
    frequency_hz, multiplicity : of the line, or of both.
    """

    mode: PredictedMode
    counts: tuple[int | None, ...]
    frequency_hz: float
    multiplicity: int

    @property
    def key(self) -> ModeKey:
        return self.mode.key

    @property
    def order(self) -> int | None:
        return self.mode.order

    @property
    def axial(self) -> int | None:
        return self.counts[0]

    @property
    def kind(self) -> str:
        return self.mode.kind

    @property
    def visibility(self) -> float:
        return self.mode.visibility


def _lines(mode: PredictedMode) -> list[_Line]:
    """A doublet that is parted by much has lines elsewhere than in its middle, and another's lie between them."""
    away, counts = abs(mode.split) / 4, _counts(mode)
    if mode.multiplicity < 2 or away < PARTED:
        return [_Line(mode, counts, mode.frequency_hz, mode.multiplicity)]
    return [_Line(mode, counts, float(np.exp(mode.log_f + side * away)), 1) for side in (-1, 1)]


def _by_name(modes: Sequence[MeasuredMode]) -> Named:
    """ln f of measured modes by order and count of node planes."""
    named: dict[tuple[int | None, int | None], list[float]] = {}
    for row in modes:
        named.setdefault((row.order, row.axial), []).append(log(row.frequency_hz))
    return named


def _of_one_name(measured: Named) -> list[float]:
    """How far (of ln f) pairs of lines lie apart that alone bear one name."""
    pairs = [
        lines for (order, axial), lines in measured.items() if order and axial is not None and len(lines) == 2
    ]
    apart = [max(lines) - min(lines) for lines in pairs]
    return [distance * (1 + ROUNDING) for distance in apart if distance <= WIDEST]


def _counts(mode: PredictedMode) -> tuple[int | None, ...]:
    """Of node planes that a mode may be called by, the likeliest first."""
    counts = mode.shown or (mode.axial,)
    return tuple(dict.fromkeys(counts if mode.other_axial is None else (*counts, mode.other_axial)))
