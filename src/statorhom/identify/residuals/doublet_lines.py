"""Where the two lines of a split doublet lie, which the fit compares with what was measured."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from statorhom.model.broken.named_response import Response
from statorhom.model.convergence import ModeKey


def line_shifts(
    frequency_hz: Sequence[float],
    keys: Sequence[ModeKey | None],
    effects: Mapping[ModeKey, Response],
    middle_hz: Mapping[ModeKey, float],
) -> list[float]:
    """How far (in ln f) the lines that were measured lie off the middle of their doublets.

    Parameters
    ----------
    frequency_hz, keys : of the measured modes, and their partners.
    effects : of the partners.
    middle_hz : simulated frequency of the partners' middle; one line alone is taken for the nearer one.
    """
    found = [0.0] * len(keys)
    for key in {k for k in keys if k is not None and k in effects and k in middle_hz}:
        own = sorted((i for i, k in enumerate(keys) if k == key), key=lambda i: frequency_hz[i])
        half = abs(effects[key].split) / 4
        if len(own) == 1:
            found[own[0]] = float(np.copysign(half, frequency_hz[own[0]] - middle_hz[key]))
        else:
            found[own[0]], found[own[-1]] = -half, half
    return found
