"""Which predicted mode every measured one is, by name and frequency."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from statorhom.diagnose.measured.measured_test import MeasuredTest
from statorhom.diagnose.predicted.prediction import PredictedMode
from statorhom.identify.stage_problem import GATE, LABELLED_GATE, PAIRING_SD
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


def assigned(
    test: MeasuredTest,
    modes: Sequence[MeasuredMode],
    predicted: Mapping[ModeKey, PredictedMode],
    reach: float = 1.0,
) -> Keys:
    """Named partner of every measured mode; `reach`: as a part of how far partners may usually lie apart."""
    seen = [_as_seen(m, modes) for m in predicted.values()]
    simulated = sorted((line for m in seen for line in _lines(m)), key=lambda line: line.frequency_hz)
    used = [i for i, mode in enumerate(modes) if not (test.recorded and mode.order is None)]
    found = pair(
        [modes[i] for i in used],
        simulated,
        reach * PAIRING_SD,
        gate=GATE,
        labelled_gate=LABELLED_GATE,
        # a heavy lump may part a doublet's lines by more than any scatter does
        doublet_split=max([DOUBLET_SPLIT, *(AS_FAR * abs(m.split) / 2 for m in seen), *_of_one_name(modes)]),
        with_doubt=False,
    )
    keys: list[ModeKey | None] = [None] * len(modes)
    for p in found.pairs:
        keys[used[p.measured]] = simulated[p.simulated].key
    return tuple(keys)


@dataclass(frozen=True)
class _Line:
    """What a test may show of a predicted mode: both lines of a doublet, or one that lies far from the other."""

    mode: PredictedMode
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
        return self.mode.axial

    @property
    def kind(self) -> str:
        return self.mode.kind

    @property
    def visibility(self) -> float:
        return self.mode.visibility


def _lines(mode: PredictedMode) -> list[_Line]:
    """A doublet that is parted by much has lines elsewhere than in its middle, and another's lie between them."""
    away = abs(mode.split) / 4
    if mode.multiplicity < 2 or away < PARTED:
        return [_Line(mode, mode.frequency_hz, mode.multiplicity)]
    return [_Line(mode, float(np.exp(mode.log_f + side * away)), 1) for side in (-1, 1)]


def _of_one_name(modes: Sequence[MeasuredMode]) -> list[float]:
    """How far (of ln f) pairs of lines lie apart that alone bear one name."""
    named: dict[tuple[int, int], list[float]] = {}
    for mode in modes:
        if mode.order and mode.axial is not None:
            named.setdefault((mode.order, mode.axial), []).append(float(np.log(mode.frequency_hz)))
    apart = [float(np.ptp(lines)) for lines in named.values() if len(lines) == 2]
    return [distance * (1 + ROUNDING) for distance in apart if distance <= WIDEST]


def _as_seen(mode: PredictedMode, modes: Sequence[MeasuredMode]) -> PredictedMode:
    """Called by the one of its counts of node planes that was measured nearest to its frequency."""
    counts = mode.shown or (mode.axial,)
    if mode.other_axial is not None:
        counts = (*counts, mode.other_axial)
    if counts == (mode.axial,):
        return mode
    away = dict.fromkeys(counts, np.inf)
    for row in modes:
        if row.order == mode.order and row.axial in away:
            away[row.axial] = min(away[row.axial], abs(np.log(row.frequency_hz) - mode.log_f))
    return replace(mode, counted=min(away, key=away.__getitem__))
