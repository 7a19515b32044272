"""Fewer modes whose frequencies shift from point to point, instead of more modes: what a roving sensor does.

A sensor's mass lowers the poles by another amount at every point. A model with poles that all points share
then needs two or three for one mode; one shift per point explains the same with far fewer unknowns. The
Bayesian information criterion decides.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import numpy.typing as npt

from statorhom.extraction.modal_model import Modes, Window, solve_linear
from statorhom.extraction.modal_model import columns as linear_columns
from statorhom.extraction.pole_price import dispersion, price, unknown_price
from statorhom.extraction.window_fit import WindowFit, fit_window, shift_terms

FloatArray = npt.NDArray[np.float64]

_STARTS = np.linspace(-3.0, 3.0, 13)  # bandwidths
_ROUNDS = 6
_STEPS = 4  # Gauss–Newton steps on the shifts per round
_OVERLAP = 3.0  # bandwidths within which shifted images of one mode lie


def with_shifts(window: Window, fit: WindowFit, neighbours: Modes) -> WindowFit:
    """The fit itself, or one with fewer modes and a shift at every point where that is the better bargain."""
    best = smaller = fit
    while (weaker := _weaker_image(smaller)) is not None:
        # one removal may not pay where the next one does: three images of one mode
        smaller = _fit_shifted(window, smaller.modes.without(weaker), neighbours)
        if _cost(window, smaller, best) < _cost(window, best, smaller):
            best = smaller
    return best


def _weaker_image(fit: WindowFit) -> int | None:
    """The weakest mode that overlaps with a stronger one; None where none does."""
    poles = fit.modes.poles
    strength = (
        np.linalg.norm((fit.linear.coefficients / fit.linear.norms)[:, : len(poles)], axis=0) / poles.imag
    )
    for m in np.argsort(strength).tolist():
        near = np.abs(poles.real - poles[m].real) < _OVERLAP * poles.imag
        if np.any(near & (strength > strength[m])):
            return int(m)
    return None


def _cost(window: Window, fit: WindowFit, other: WindowFit) -> float:
    """BIC, with the smaller misfit of the two fits as noise."""
    noise = min(dispersion(window, fit), dispersion(window, other))
    shifts = 0 if fit.modes.shift is None else len(fit.modes.shift)
    return 2 * fit.chi2 / noise + len(fit.modes) * price(window) + shifts * unknown_price(window)


def _fit_shifted(window: Window, modes: Modes, neighbours: Modes) -> WindowFit:
    """Poles and shifts in turn, from the best of a row of common shifts at every point."""
    if modes.shift is None:
        loss = float(np.median(modes.poles.imag / modes.poles.real))
        points = len(window.values)
        starts = 0.5 * _STARTS * loss
        chi2 = [
            solve_linear(
                window, linear_columns(window, replace(modes, shift=np.full(points, one)), neighbours)
            ).chi2
            for one in starts
        ]
        modes = _centred(replace(modes, shift=starts[np.argmin(chi2, axis=0)]))
    fit = fit_window(window, modes, neighbours, _STEPS)
    for _ in range(_ROUNDS):
        moved = _centred(_shifted(window, fit.modes, neighbours))
        improved = fit_window(window, moved, neighbours, _STEPS)
        if improved.chi2 >= fit.chi2 * (1 - 1e-4):
            return improved if improved.chi2 < fit.chi2 else fit
        fit = improved
    return fit


def _shifted(window: Window, modes: Modes, neighbours: Modes) -> Modes:
    """Gauss–Newton on every point's own shift."""
    assert modes.shift is not None
    shift = modes.shift
    limit = 0.3 * float(np.median(modes.poles.imag / modes.poles.real))
    chi2, slope, curvature = shift_terms(window, modes, neighbours)
    factor = np.ones(len(shift))
    for _ in range(_STEPS):
        step = np.divide(slope, curvature, out=np.zeros_like(slope), where=curvature > 0)
        trial = shift + factor * np.clip(step, -limit, limit)
        found = shift_terms(window, replace(modes, shift=trial), neighbours)
        better = found[0] <= chi2
        shift = np.where(better, trial, shift)
        factor = np.where(better, 1.0, 0.3 * factor)
        chi2, slope, curvature = (
            np.where(better, new, old) for new, old in zip(found, (chi2, slope, curvature), strict=True)
        )
    return replace(modes, shift=shift)


def _centred(modes: Modes) -> Modes:
    """The same poles with shifts of median 0: what all points share belongs to the poles."""
    assert modes.shift is not None
    middle = float(np.median(modes.shift))
    return replace(modes, poles=modes.poles * (1 + middle) ** 2, shift=(1 + modes.shift) / (1 + middle) - 1)
