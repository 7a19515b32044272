"""How much each line of a mode says of it.

The peak of a mode that is not linear leaves images beside it, of which hardly the frequency is known; they say little.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from statorhom.diagnose.features.mode_features import measured_sd
from statorhom.study.modal_table import MeasuredMode

APART = 1e-3  # of their frequency: lines known better than this count alike, for a doublet's lie apart anyhow


def line_weights(rows: Sequence[MeasuredMode]) -> np.ndarray:
    """Weights of the lines of one mode, shape (rows,); their sum is 1."""
    weights = 1.0 / (np.array([measured_sd(row) for row in rows]) ** 2 + APART**2)
    return np.asarray(weights / weights.sum())
