"""Complex mode indication function: how many shapes move at a frequency.

Shih, Tsuei, Allemang & Brown (1988): the singular values of the FRF matrix at every line. With one reference
there is one curve; a doublet with two references lifts the second curve at the same frequency.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from statorhom.extraction.point_grid import PointGrid

FloatArray = npt.NDArray[np.float64]


def cmif(grid: PointGrid) -> FloatArray:
    """Singular values of the receptance matrix (m/N), largest first, shape (min(points, references), lines)."""
    matrices = np.moveaxis(grid.receptance, -1, 0)
    return np.asarray(np.linalg.svd(matrices, compute_uv=False).T, dtype=np.float64)
