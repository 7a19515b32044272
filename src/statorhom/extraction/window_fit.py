"""Maximum-likelihood fit of the modes in a window of lines by variable projection.

Poles s and participations L are non-linear, shapes φ and residual terms are
linear and eliminated point by point (Golub & Pereyra 1973; gradient exact, Hessian Gauss–Newton after
Kaufman 1975). All unknowns are complex and the model is analytic in them, so every matrix is Hermitian.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from statorhom.extraction.modal_model import (
    RANK,
    Linear,
    Modes,
    Window,
    columns,
    fitted,
    free_parts,
    modal_columns,
    projected,
    solve_linear,
    unit_part,
    weighted_gram,
    weighted_products,
)

FloatArray = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]

_ITERATIONS = 25
_TRIES = 4  # dampings tried for one step
_CONVERGED = 1e-3  # decrease of χ² that is worth a further step, per unknown: 3 % of a standard deviation
_CONVERGED_MISFIT = 1e-6  # the same relative to χ², where misfit exceeds the noise by far
_LARGEST_STEP = 0.7  # of a pole, in units of its half-power bandwidth
_LEAST_LOSS = 1e-7


@dataclass(frozen=True)
class WindowFit:
    """Result of a fit.

    Attributes
    ----------
    modes : Modes
    chi2 : float
        Σ |residual|²/variance over all data.
    linear : Linear
    hessian : complex array, shape (unknowns, unknowns)
        Inverse covariance of poles, then of the free components of the participations.
    cross : complex array, shape (points, columns, unknowns)
        Change of the (scaled) linear unknowns with the non-linear ones.
    """

    modes: Modes
    chi2: float
    linear: Linear
    hessian: ComplexArray
    cross: ComplexArray


def fit_window(
    window: Window, modes: Modes, neighbours: Modes | None = None, iterations: int = _ITERATIONS
) -> WindowFit:
    """Levenberg–Marquardt over poles and participations, starting from `modes`."""
    state = _state(window, modes, neighbours)
    damping = 1e-3
    for _ in range(iterations if len(modes) else 0):
        fit, gradient = state
        accepted = None
        for _ in range(_TRIES):
            step = _step(fit, gradient, damping)
            trial = _moved(fit.modes, step)
            candidate = _state(window, trial, neighbours)
            if candidate[0].chi2 <= fit.chi2:  # never for NaN
                accepted = candidate
                break
            damping *= 16.0
        if accepted is None:
            break
        gained = fit.chi2 - accepted[0].chi2
        state, damping = accepted, max(damping / 6.0, 1e-12)
        if gained < max(_CONVERGED * len(gradient), _CONVERGED_MISFIT * fit.chi2):
            break
    return state[0]


def _state(window: Window, modes: Modes, neighbours: Modes | None) -> tuple[WindowFit, ComplexArray]:
    """Fit at given non-linear unknowns, and half the negative gradient of χ²."""
    phi = columns(window, modes, neighbours)
    linear = solve_linear(window, phi)
    points = len(window.values)
    flat = phi.reshape(len(phi), phi.shape[1], -1)
    residual = window.values.reshape(points, -1) - fitted(linear.unscaled, flat)
    linear = replace(linear, correlation=residual_correlation(window, residual))
    empty = np.zeros((0, 0), dtype=complex)
    if not len(modes):
        cross = np.zeros((len(linear.chi2), phi.shape[1], 0), dtype=complex)
        return WindowFit(modes, float(linear.chi2.sum()), linear, empty, cross), np.zeros(0, dtype=complex)
    derivative, owner = _derivatives(window, modes)
    score, inner, cross = reduced_terms(window, flat, linear, residual, derivative, owner)
    fit = WindowFit(modes, float(linear.chi2.sum()), linear, inner.sum(axis=0), cross)
    return fit, score.sum(axis=0)


def reduced_terms(
    window: Window,
    flat: ComplexArray,
    linear: Linear,
    residual: ComplexArray,
    derivative: ComplexArray,
    owner: npt.NDArray[np.int_],
) -> tuple[ComplexArray, ComplexArray, ComplexArray]:
    """Every point's part of gradient and Hessian with its linear unknowns eliminated, and their change.

    Parameters
    ----------
    flat : complex array, shape (1 or points, columns, data)
    residual : complex array, shape (points, data)
    derivative : complex array, shape (1 or points, unknowns, references, lines)
        Of the columns of the modes, by each unknown.
    owner : int array, shape (unknowns,)
        The mode that each unknown belongs to.
    """
    weights = window.weights.reshape(len(window.values), -1)
    flat_d = derivative.reshape(len(derivative), derivative.shape[1], -1)
    amplitude = linear.unscaled[:, owner]
    score = amplitude.conj() * projected(flat_d, weights * residual)
    d_phi = weighted_products(weights, flat_d, flat) / linear.norms[:, None, :]
    moved = linear.inverse @ d_phi.conj().transpose(0, 2, 1)  # (points, columns, unknowns)
    inner = weighted_gram(weights, flat_d) - d_phi @ moved
    inner = amplitude.conj()[:, :, None] * inner * amplitude[:, None, :]
    return score, inner, -moved * amplitude[:, None, :]


def residual_correlation(window: Window, residual: ComplexArray) -> float:
    """Integrated autocorrelation along the lines if neighbours are correlated as in an AR(1) process, ≥ 1."""
    white = residual.reshape(window.values.shape) * np.sqrt(window.weights)
    energy = float(np.sum(np.abs(white) ** 2))
    if energy == 0.0:
        return 1.0
    beside = float(np.sum((white[..., 1:] * white[..., :-1].conj()).real)) / energy
    return (1 + beside) / (1 - beside) if 0.0 < beside < 1.0 else 1.0


def _derivatives(window: Window, modes: Modes) -> tuple[ComplexArray, npt.NDArray[np.int_]]:
    """Derivative of each mode's column by each of its unknowns, and the mode that each unknown belongs to."""
    by_pole = -modal_columns(window, modes, power=2)
    if modes.moving.any():
        by_pole = by_pole * ((1 + modes.shift) ** 2)[..., None]
    references = modes.parts.shape[1]
    free = free_parts(modes)
    owner = np.concatenate([np.arange(len(modes)), free[:, 0]]).astype(int)
    if not len(free):
        return by_pole, owner
    ones = replace(modes, parts=np.ones((len(modes), references), dtype=complex))
    curve = modal_columns(window, ones)
    by_part = np.zeros((len(curve), len(free), *curve.shape[2:]), dtype=complex)
    for i, (mode, reference) in enumerate(free):
        by_part[:, i, reference] = curve[:, mode, reference]
    return np.concatenate([by_pole, by_part], axis=1), owner


def _step(fit: WindowFit, gradient: ComplexArray, damping: float) -> ComplexArray:
    size = np.diag(fit.hessian).real
    # an unknown without influence stays where it is
    diagonal = np.sqrt(np.where(size > RANK * size.max(initial=0.0), size, np.inf))
    scaled = fit.hessian / np.outer(diagonal, diagonal)
    scaled = scaled + damping * np.eye(len(diagonal))
    step: ComplexArray = np.linalg.pinv(scaled, rcond=RANK, hermitian=True) @ (gradient / diagonal) / diagonal
    return step


def _moved(modes: Modes, step: ComplexArray) -> Modes:
    count = len(modes)
    change = step[:count]
    limit = _LARGEST_STEP * modes.poles.imag / np.maximum(np.abs(change), np.finfo(float).tiny)
    poles = modes.poles + change * np.minimum(1.0, limit)
    poles = poles.real + 1j * np.maximum(poles.imag, _LEAST_LOSS * np.abs(poles.real))
    parts = modes.parts.copy()
    free = free_parts(modes)
    if len(free):
        parts[free[:, 0], free[:, 1]] += step[count:]
        parts = np.array([unit_part(part) for part in parts])
    return replace(modes, poles=poles, parts=parts)
