"""Identified constants against mechanical tests of samples."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from statorhom.identify.bounds import Array


def difference_percent(found: ArrayLike, reference: ArrayLike) -> Array:
    """|found − reference| / reference in per cent: the seeds' equations (11) and (13)."""
    reference = np.asarray(reference, dtype=float)
    return np.asarray(100.0 * np.abs((np.asarray(found, dtype=float) - reference) / reference))
