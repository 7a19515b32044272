"""How far below its Ritz value an eigenvalue can lie.

For A = K + σM, a Ritz pair (μ, x) of A x = μ M x with xᵀMx = 1 and its residual r, some eigenvalue lies above
μ/(1 + ε), ε² = rᵀA⁻¹r/μ. Let ρ be such a barrier of the l-th Ritz value. Lehmann's bounds for the window of Ritz
vectors j … l-1 below it (Goerisch's form, in which A⁻¹ takes the place of M⁻¹) say that the j-th eigenvalue is at least

    ρ μ_j / (ρ + t (ρ - μ_j)),    t = ρ² Σ_{i=j}^{l-1} r_iᵀA⁻¹r_i / (μ_i (ρ - μ_i)²).

With one vector this is Kato's and Temple's bound, quadratic in the residual; with several, modes may lie as close
together as they like. The smallest distance of all l counts. The bounds hold where the basis misses no mode
altogether, which no residual can tell: the full solutions at the snapshots do.

Source: F. Goerisch and H. Haunhorst, Eigenwertschranken für Eigenwertaufgaben, ZAMM 65 (1985) 129-135.
"""

from __future__ import annotations

import numpy as np

from statorhom.model.stator_mode import RIGID_HZ

RIGID = (2 * np.pi * RIGID_HZ) ** 2


def eigenvalue_drops(values: np.ndarray, squared: np.ndarray, shift: float) -> np.ndarray:
    """Bound of λ̃ - λ for Ritz values λ̃.

    Parameters
    ----------
    values : (…, J) Ritz values, ascending; infinite ones are padding.
    squared : (…, J) rᵀA⁻¹r of each, or an upper bound of it.
    shift : σ > 0.

    Returns
    -------
    drops : (…, J), infinite where nothing is known, as of the last one.
    """
    known = np.isfinite(values)
    mu = np.where(known, values, 0.0) + shift
    share = squared / mu  # ε²
    barrier = np.where(known, mu / (1.0 + np.sqrt(share)), 0.0)
    # axes: …, barrier l, vector i; a barrier serves the windows that end just below it, where that vector lies below
    serves = np.zeros(barrier.shape, bool)
    serves[..., 1:] = barrier[..., 1:] > mu[..., :-1]
    window = serves[..., None] & np.tri(mu.shape[-1], k=-1, dtype=bool)
    distance = np.where(window, barrier[..., None] - mu[..., None, :], np.inf)
    terms = share[..., None, :] / distance**2
    t = barrier[..., None] ** 2 * np.cumsum(terms[..., ::-1], axis=-1)[..., ::-1]
    drop = mu[..., None, :] * t / (1.0 + t + mu[..., None, :] / distance)
    return np.asarray(np.where(window, drop, np.inf).min(axis=-2))


def frequency_errors(values: np.ndarray, drops: np.ndarray) -> np.ndarray:
    """Bounds of the relative errors of frequencies, f̃/f - 1; none for rigid bodies, whose frequencies are rounding."""
    left = np.subtract(values, drops, out=np.zeros_like(values), where=drops < values)
    errors = np.divide(0.5 * drops, left, out=np.full_like(left, np.inf), where=left > 0.0)
    return np.where(values < RIGID, 0.0, errors)
