"""Directions that hold most of a great many columns, none of which is kept.

The columns A of a search are tens of thousands. Of them a sketch A Aᵀ Ω is summed up for a few more random vectors Ω
than directions are sought, and these follow from it (Nyström's method; Tropp, Yurtsever, Udell and Cevher 2017,
Adv. Neural Inf. Process. Syst. 30).
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from scipy.linalg import solve_triangular

SPARE = 40  # random vectors more than directions
SEED = 0
SHIFT = 1e-14  # part of a sketch that rounding leaves open


def sketch(columns: np.ndarray, most: int) -> np.ndarray:
    """A Aᵀ Ω (n, v) of some columns (n, t), for at most `most` directions; those of several are added."""
    return np.asarray(columns @ (columns.T @ _tested(len(columns), most)))


def leading_directions(total: np.ndarray, most: int) -> tuple[np.ndarray, np.ndarray]:
    """Left singular vectors (n, v) and values (v,) of all columns, the largest first, v at most `most`.

    Parameters
    ----------
    total : sum of the columns' sketches, for as many directions.
    """
    tested, shift = _tested(len(total), most), SHIFT * float(np.linalg.norm(total))
    shifted = total + shift * tested
    inner = tested.T @ shifted
    root = np.linalg.cholesky((inner + inner.T) / 2)
    left, values, _ = np.linalg.svd(solve_triangular(root, shifted.T, lower=True).T, full_matrices=False)
    return left[:, :most], np.sqrt(np.maximum(values[:most] ** 2 - shift, 0.0))


@lru_cache(maxsize=4)
def _tested(rows: int, most: int) -> np.ndarray:
    """Ω (n, v); all directions where there are few."""
    wide = most + SPARE
    found = np.eye(rows) if rows <= 2 * wide else np.random.default_rng(SEED).standard_normal((rows, wide))
    found.setflags(write=False)
    return found
