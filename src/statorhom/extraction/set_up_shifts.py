"""Poles that move from set-up to set-up: one mode with a shift per set-up instead of several modes.

A roving sensor's mass, or supports that settle between two hammer points, put the poles of every set-up
elsewhere. A model with poles that all FRFs share then needs two or three for one mode; one shift per set-up
explains the same with far fewer unknowns. Shifts are non-linear unknowns of their own: Gauss–Newton on them
takes turns with that on poles and participations.
"""

from __future__ import annotations

from dataclasses import replace
from enum import Enum

import numpy as np
import numpy.typing as npt

from statorhom.extraction.modal_model import Modes, Window, columns, fitted, modal_columns, solve_linear
from statorhom.extraction.window_fit import WindowFit, fit_window, reduced_terms

FloatArray = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]
IntArray = npt.NDArray[np.int_]

_STARTS = np.linspace(-2.0, 2.0, 9)  # bandwidths
_ROUNDS = 6
_STEPS = 5  # Gauss–Newton steps per round
_LARGEST_STEP = 0.5  # bandwidths
_PRIOR = (
    1.0  # bandwidths: standard deviation of shifts before the data, which keeps those of unseen modes at 0
)
_LEAST_GAIN = 1e-4  # part of χ² that a further round must bring


class SetUps(Enum):
    """What a set-up is: the place of the roving point, or one of the references."""

    POINTS = "points"
    REFERENCES = "references"

    def count(self, window: Window) -> int:
        """Number of set-ups."""
        return window.values.shape[0 if self is SetUps.POINTS else 1]


def shift_gains(window: Window, fit: WindowFit, neighbours: Modes, set_ups: SetUps) -> FloatArray:
    """Gain in χ² that real shifts of each mode alone promise, to first order, shape (modes,)."""
    _, score, inner = _terms(window, fit.modes, neighbours, np.arange(len(fit.modes)), set_ups)
    diagonal = np.einsum("gaa->ga", inner)
    gain = np.divide(score.real**2, diagonal, out=np.zeros_like(diagonal), where=diagonal > 0)
    # points are groups with one shift per mode; references make one group with a shift per mode and reference
    of_modes = gain if set_ups is SetUps.POINTS else gain.reshape(len(fit.modes), -1).T
    return np.asarray(of_modes.sum(axis=0))


def fit_shifted(
    window: Window,
    modes: Modes,
    neighbours: Modes,
    moving: npt.ArrayLike,
    set_ups: SetUps,
    damped: bool = False,
) -> WindowFit:
    """Fit with free shifts of some modes; a plain one where none is to move.

    Parameters
    ----------
    moving : mask of shape (modes,)
    damped : bool
        Whether the damping shifts as well.
    """
    chosen = np.flatnonzero(np.asarray(moving, dtype=bool))
    if not len(chosen):
        return fit_window(window, modes, neighbours)
    modes = _opened(window, modes, set_ups)
    if set_ups is SetUps.POINTS:
        for m in chosen:
            if not modes.moving[m]:
                modes = _scanned(window, modes, neighbours, int(m))
    best: WindowFit | None = None
    for _ in range(_ROUNDS):
        modes = _centred(_shifted(window, modes, neighbours, chosen, set_ups, damped))
        fit = fit_window(window, modes, neighbours, _STEPS)
        modes = fit.modes
        if best is not None and fit.chi2 >= best.chi2 * (1 - _LEAST_GAIN):
            return fit if fit.chi2 < best.chi2 else best
        best = fit
    assert best is not None
    return best


def _opened(window: Window, modes: Modes, set_ups: SetUps) -> Modes:
    shape = [len(window.values), len(modes), window.values.shape[1]]
    shape[2 if set_ups is SetUps.POINTS else 0] = 1
    return replace(modes, shift=np.broadcast_to(modes.shift, shape).astype(complex))


def _scanned(window: Window, modes: Modes, neighbours: Modes, mode: int) -> Modes:
    """Every point's best shift of one mode out of a row of common ones: neighbours must not catch the fit."""
    starts = _STARTS * modes.loss_factors[mode]
    chi2 = []
    for start in starts:
        shift = modes.shift.copy()
        shift[:, mode] = start
        chi2.append(solve_linear(window, columns(window, replace(modes, shift=shift), neighbours)).chi2)
    shift = modes.shift.copy()
    shift[:, mode, 0] = starts[np.argmin(chi2, axis=0)]
    return _centred(replace(modes, shift=shift))


def _terms(
    window: Window, modes: Modes, neighbours: Modes, chosen: IntArray, set_ups: SetUps
) -> tuple[FloatArray, ComplexArray, FloatArray]:
    """χ², half its negative slope and half its curvature over the shifts, by independent groups.

    Points are groups of their own, with one shift per mode: shapes (points,), (points, modes), (points, modes,
    modes). All references share the shapes and make one group, with a shift per mode and reference.
    """
    phi = columns(window, modes, neighbours)
    linear = solve_linear(window, phi)
    flat = phi.reshape(len(phi), phi.shape[1], -1)
    values = window.values.reshape(len(window.values), -1)
    residual = values - fitted(linear.unscaled, flat)
    # ∂/∂δ of 1/(s(1 + δ)² − ω²)
    chain = -2 * modes.poles[:, None] * (1 + modes.shift)
    derivative = (modal_columns(window, modes, power=2) * chain[..., None])[:, chosen]
    owner = chosen
    if set_ups is SetUps.REFERENCES:
        references = derivative.shape[2]
        apart = derivative[:, :, None] * np.eye(references)[:, :, None]
        derivative = apart.reshape(len(apart), -1, *derivative.shape[2:])
        owner = np.repeat(chosen, references)
    score, inner, _ = reduced_terms(window, flat, linear, residual, derivative, owner)
    if set_ups is SetUps.POINTS:
        return linear.chi2, score, inner.real
    return linear.chi2.sum()[None], score.sum(axis=0)[None], inner.real.sum(axis=0)[None]


def _shifted(
    window: Window, modes: Modes, neighbours: Modes, chosen: IntArray, set_ups: SetUps, damped: bool
) -> Modes:
    """Levenberg–Marquardt on the shifts of the chosen modes, every group by itself."""
    prior = _PRIOR * modes.loss_factors[chosen]
    limit = _LARGEST_STEP * modes.loss_factors[chosen]
    if set_ups is SetUps.REFERENCES:
        prior, limit = (np.repeat(one, window.values.shape[1]) for one in (prior, limit))

    def grouped(shift: ComplexArray) -> ComplexArray:
        # (points or 1, modes, references or 1) → (groups, unknowns)
        own = shift[:, chosen]
        return own[..., 0] if set_ups is SetUps.POINTS else own.reshape(1, -1)

    def evaluated(trial: ComplexArray) -> tuple[FloatArray, ComplexArray, FloatArray]:
        chi2, score, inner = _terms(window, replace(modes, shift=trial), neighbours, chosen, set_ups)
        own = grouped(trial)
        penalty = np.sum(np.abs(own) ** 2 / prior**2, axis=1)
        return chi2 + penalty, score - own / prior**2, inner + np.diag(1 / prior**2)

    shift = modes.shift
    chi2, score, inner = evaluated(shift)
    damping = np.full(len(chi2), 1e-4)
    for _ in range(_STEPS):
        diagonal = np.einsum("gaa->ga", inner)
        lifted = inner + (damping[:, None] * diagonal)[:, :, None] * np.eye(inner.shape[-1])
        step = np.linalg.solve(lifted, score[..., None])[..., 0]
        if not damped:
            step = step.real + 0j
        step *= np.minimum(1.0, limit / np.maximum(np.abs(step), np.finfo(float).tiny))
        trial = shift.copy()
        trial[:, chosen] += step.reshape(len(shift), len(chosen), -1)
        found = evaluated(trial)
        better = found[0] <= chi2
        gained = float(np.sum(np.where(better, chi2 - found[0], 0.0)))
        shift = np.where(better[:, None, None], trial, shift)
        damping = np.where(better, damping / 8, np.maximum(16 * damping, 1e-3))
        chi2, score, inner = (
            np.where(better.reshape(-1, *[1] * (new.ndim - 1)), new, old)
            for new, old in zip(found, (chi2, score, inner), strict=True)
        )
        if better.all() and gained < _LEAST_GAIN * chi2.sum():
            break
    return replace(modes, shift=shift)


def _centred(modes: Modes) -> Modes:
    """The same poles with shifts of median 0: what all set-ups share belongs to the poles."""
    middle = np.median(modes.shift.real, axis=(0, 2)) + 1j * np.median(modes.shift.imag, axis=(0, 2))
    shift = (1 + modes.shift) / (1 + middle[:, None]) - 1
    return replace(modes, poles=modes.poles * (1 + middle) ** 2, shift=shift)
