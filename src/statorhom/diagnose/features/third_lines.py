"""A line without a partner as the third one of a name: of broken symmetry a name has more lines than a doublet.

A heavy lump mixes (2, 2) and (4, 1): of four lines three are called (4, 1), which stand where the model has them.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from math import log

from statorhom.diagnose.features.lost_lines import LINES
from statorhom.diagnose.predicted.prediction import PredictedMode
from statorhom.study.modal_table import MeasuredMode


def third_lines(
    row: MeasuredMode, mates: Sequence[MeasuredMode], mode: PredictedMode
) -> Iterator[PredictedMode]:
    """What a line without a partner may be of a mode: each line of its name, alone, that is nearest to this one.

    Parameters
    ----------
    row : the line.
    mates : lines that are partners of the mode, whose own lines are theirs.
    mode : one that the line may be called by.
    """
    if len(mates) != LINES or row.order is None or any(_name(m) != _name(row) for m in mates):
        return
    measured, taken = log(row.frequency_hz), [log(m.frequency_hz) for m in mates]
    for line in mode.lines:
        log_f = mode.log_f + line.shift
        if abs(log_f - measured) < min(abs(log_f - other) for other in taken):
            yield replace(mode, log_f=log_f, chance=line.chance)


def _name(row: MeasuredMode) -> tuple[int | None, int | None]:
    return row.order, row.axial
