"""Small dense eigenproblems, many at a time."""

from __future__ import annotations

import numpy as np


def ritz_pairs(K: np.ndarray, M: np.ndarray | None) -> tuple[np.ndarray, np.ndarray]:
    """All pairs of K x = λ M x.

    Parameters
    ----------
    K : (…, k, k) symmetric.
    M : (…, k, k) definite, or None for the identity.

    Returns
    -------
    values : (…, k) ascending.
    vectors : (…, k, k), columns of unit mass.
    """
    if M is None:
        values, vectors = np.linalg.eigh(K)
        return values, vectors
    root = np.linalg.inv(np.linalg.cholesky(M))
    turned = np.swapaxes(root, -1, -2)
    values, vectors = np.linalg.eigh(root @ K @ turned)
    return values, turned @ vectors
