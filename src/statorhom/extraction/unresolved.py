"""Two poles whose distance the data do not tell: one mode, and a remark.

One reference shows two modes of almost one frequency as one pole whose residues are a mixture of both shapes.
Where their split is below its own uncertainty, the two poles share what belongs to one of them at will.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import numpy.typing as npt

from statorhom.extraction.mode_search import FittedWindow
from statorhom.extraction.pole_price import dispersion
from statorhom.extraction.window_fit import WindowFit, fit_window

_APART = 2.0  # standard deviations of the split
_PARALLEL = 0.95  # MAC


def without_unresolved(one: FittedWindow) -> tuple[FittedWindow, tuple[complex, ...]]:
    """The window with one mode for every pair that is not resolved, and these modes' poles ((rad/s)²)."""
    merged: list[complex] = []
    while (pair := _unresolved(one)) is not None:
        kept, gone = pair
        merged.append(complex(one.fit.modes.poles[kept]) * one.window.unit)
        fit = fit_window(one.window, one.fit.modes.without(gone), one.neighbours)
        one = replace(one, fit=fit)
    return one, tuple(merged)


def _unresolved(one: FittedWindow) -> tuple[int, int] | None:
    """The stronger and the weaker mode of the least resolved pair; None where all are resolved."""
    fit = one.fit
    count = len(fit.modes)
    if count < 2 or fit.modes.moving.any():
        return None
    split = np.abs(fit.modes.poles[:, None] - fit.modes.poles[None])
    parallel = _likeness(fit.modes.parts) > _PARALLEL
    ratio = np.where(parallel & ~np.eye(count, dtype=bool), split / _split_sd(one), np.inf)
    a, b = np.unravel_index(np.argmin(ratio), ratio.shape)
    if ratio[a, b] > _APART:
        return None
    size = _size(fit)
    return (int(a), int(b)) if size[a] >= size[b] else (int(b), int(a))


def _likeness(parts: npt.NDArray[np.complex128]) -> npt.NDArray[np.float64]:
    """MAC between the participations of all modes: several references tell modes of one frequency apart by them."""
    unit = parts / np.linalg.norm(parts, axis=1, keepdims=True)
    likeness: npt.NDArray[np.float64] = np.abs(unit.conj() @ unit.T) ** 2
    return likeness


def _split_sd(one: FittedWindow) -> npt.NDArray[np.float64]:
    count = len(one.fit.modes)
    inverse = np.linalg.pinv(one.fit.hessian, rcond=1e-14, hermitian=True)[:count, :count]
    covariance = inverse * dispersion(one.window, one.fit)
    own = np.diag(covariance).real
    variance = own[:, None] + own[None] - 2 * covariance.real
    sd: npt.NDArray[np.float64] = np.sqrt(np.maximum(variance, np.finfo(float).tiny))
    return sd


def _size(fit: WindowFit) -> npt.NDArray[np.float64]:
    amplitude = fit.linear.unscaled[:, : len(fit.modes)]
    size: npt.NDArray[np.float64] = np.linalg.norm(amplitude, axis=0) * np.linalg.norm(
        fit.modes.parts, axis=1
    )
    return size
