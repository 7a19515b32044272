"""Directions that hold most of a great many columns.

A full decomposition of ten thousands of columns takes minutes. A few more random sums of them than directions are
sought hold these nearly whole, and what all columns make of those sums once more does but for rounding
(Halko, Martinsson and Tropp 2011, SIAM Rev. 53, 217).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

SPARE = 40  # sums more than directions
SEED = 0


def leading_directions(parts: Sequence[np.ndarray], most: int) -> tuple[np.ndarray, np.ndarray]:
    """Left singular vectors (n, v) and values (v,) of all columns, the largest first, v at most `most`.

    Parameters
    ----------
    parts : (n, t) columns each, one matrix after the other.
    """
    sums = most + SPARE
    columns = sum(part.shape[1] for part in parts)
    if min(len(parts[0]), columns) <= 2 * sums:
        left, values, _ = np.linalg.svd(np.hstack(parts), full_matrices=False)
        return left[:, :most], values[:most]
    rng = np.random.default_rng(SEED)
    basis = np.linalg.qr(sum(part @ rng.standard_normal((part.shape[1], sums)) for part in parts))[0]
    basis = np.linalg.qr(sum(part @ (part.T @ basis) for part in parts))[0]
    squares, turn = np.linalg.eigh(sum(inside @ inside.T for inside in (basis.T @ part for part in parts)))
    largest = np.argsort(-squares)[:most]
    return basis @ turn[:, largest], np.sqrt(np.maximum(squares[largest], 0.0))
