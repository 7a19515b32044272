"""A line without a partner as the third one of a name: of broken symmetry a name has more lines than a doublet.

A heavy lump mixes (2, 2) and (4, 1): of four lines three are called (4, 1), which stand where the model has them.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import log

from statorhom.diagnose.features.lost_lines import LINES
from statorhom.diagnose.features.mixed_modes import cost_of
from statorhom.diagnose.measured.feature import Feature
from statorhom.diagnose.predicted.prediction import PredictedMode
from statorhom.study.modal_table import MeasuredMode


def third_line(
    lost: Feature,
    row: MeasuredMode,
    mates: Sequence[MeasuredMode],
    mode: PredictedMode,
    sds: tuple[float, float],
) -> Feature:
    """A lost line, or its frequency as that of another line of a mode, where that is likelier.

    Parameters
    ----------
    lost, row : the penalty, and the line that it is of.
    mates : lines that are partners of the mode.
    mode : one that the line may be called by.
    sds : of the frequency: standard deviation, and the least that any has (`Feature.least`).
    """
    if len(mates) != LINES or row.order is None or any(_name(m) != _name(row) for m in mates):
        return lost
    measured, taken = log(row.frequency_hz), [log(m.frequency_hz) for m in mates]
    found = [lost]
    for line in mode.lines:
        log_f = mode.log_f + line.shift
        # the mates' own lines are theirs
        if abs(log_f - measured) < min(abs(log_f - other) for other in taken):
            found.append(
                Feature(
                    "frequency",
                    lost.test,
                    mode.key,
                    measured,
                    log_f,
                    sds[0],
                    rows=lost.rows,
                    chance=line.chance,
                    least=sds[1],
                    third=True,
                )
            )
    return min(found, key=lambda f: cost_of([f]))


def _name(row: MeasuredMode) -> tuple[int | None, int | None]:
    return row.order, row.axial
