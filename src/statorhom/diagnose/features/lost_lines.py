"""Measured lines that the model has no mode for."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from statorhom.diagnose.measured.feature import LOST, LOST_UNNAMED, Feature
from statorhom.diagnose.measured.measured_test import MeasuredTest
from statorhom.study.modal_table import MeasuredMode

USUAL_ORDERS = 6
LINES = 2  # of a doublet
TORN = 0.02  # typical split of a test in which names hardly say more than that there is a mode


def lost_lines(
    test: MeasuredTest, lost: Sequence[MeasuredMode], modes: Sequence[MeasuredMode], typical: float
) -> list[Feature]:
    """Features of lines without a partner; what a recording shows beyond the usual orders may be another's image.

    What parts the lines of doublets by much mixes orders too, and a line may bear the name of any of them.

    Parameters
    ----------
    test, lost, modes : the lines, and all of their test.
    typical : root mean square of the test's splits.
    """
    rows = _without_images(lost, modes) if test.recorded else lost
    named = LOST_UNNAMED + (LOST - LOST_UNNAMED) * float(np.exp(-typical / TORN))
    kept = [m for m in rows if not test.recorded or (m.order is not None and m.order <= USUAL_ORDERS)]
    return [
        Feature(
            "frequency",
            test.name,
            None,
            named if m.order is not None else LOST_UNNAMED,
            0.0,
            1.0,
            lost=True,
            rows=(m.label,),
        )
        for m in kept
    ]


def _without_images(lost: Sequence[MeasuredMode], modes: Sequence[MeasuredMode]) -> list[MeasuredMode]:
    """Lost lines but those that stand beside two of their name within a resonance: no stator has three lines there."""
    missing = {m.label for m in lost}
    kept: list[MeasuredMode] = []
    for mode in lost:
        near = [m for m in modes if (m.order, m.axial) == (mode.order, mode.axial) and _overlap(m, mode)]
        own = {m.label for m in near}
        taken = sum(m.label not in missing for m in near) + sum(m.label in own for m in kept)
        if taken < LINES:
            kept.append(mode)
    return kept


def _overlap(one: MeasuredMode, other: MeasuredMode) -> bool:
    """Whether a line lies within another's resonance."""
    return abs(one.frequency_hz - other.frequency_hz) <= (other.loss_factor or 0.0) * other.frequency_hz / 2
