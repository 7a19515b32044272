"""One probability for a mode from those of its FRFs."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt


def combined_probability(probabilities: npt.ArrayLike) -> float:
    """Combine the probabilities of one mode's FRFs by Cauchy's distribution (Liu & Xie 2020).

    Small results are trustworthy also where the FRFs' errors are correlated, and one FRF at a node of the
    mode, which shows nothing, does not hide what the others show.

    Parameters
    ----------
    probabilities : array_like, shape (FRFs,)
        NaN is left out.

    Returns
    -------
    float
        NaN without any.
    """
    p = np.asarray(probabilities, dtype=float)
    p = p[np.isfinite(p)]
    if not p.size:
        return float("nan")
    # one FRF that fits too well must not outweigh all others
    p = np.clip(p, np.finfo(float).eps, 1 - 1 / max(p.size, 2))
    return float(0.5 - np.arctan(np.mean(np.tan((0.5 - p) * np.pi))) / np.pi)
