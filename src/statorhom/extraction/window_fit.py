"""Maximum-likelihood fit of the modes in a window of lines by variable projection.

Model of the receptance between point k and reference j, with structural damping (equation [7] of the
stator's paper without its misprints): Σ_m φ_mk L_mj / (s_m(1 + δ_k)² − ω²) + residual terms of every
reference, s_m = ω_m²(1 + iη_m). Poles s and participations L are non-linear, shapes φ and residual terms are
linear and eliminated point by point (Golub & Pereyra 1973; gradient exact, Hessian Gauss–Newton after
Kaufman 1975). All unknowns are complex and the model is analytic in them, so every matrix is Hermitian.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]

_RANK = 1e-12  # eigenvalues of scaled normal matrices below this are zero
_ITERATIONS = 25
_TRIES = 4  # dampings tried for one step
_CONVERGED = 1e-3  # decrease of χ² that is worth a further step, per unknown: 3 % of a standard deviation
_CONVERGED_MISFIT = 1e-6  # the same relative to χ², where misfit exceeds the noise by far
_LARGEST_STEP = 0.7  # of a pole, in units of its half-power bandwidth
_LEAST_LOSS = 1e-7


@dataclass(frozen=True)
class Window:
    """Data of a window: receptances of all points, references and lines, scaled.

    Attributes
    ----------
    squared : array, shape (lines · bin,)
        ω² over `unit`.
    values, weights : arrays, shape (points, references, lines)
        Receptances, means over bins of neighbouring lines, and their inverse variances; weight 0 where
        nothing was measured. The model is averaged over the same lines, so that bins cost no accuracy.
    unit : float
        (rad/s)² of one unit of `squared`.
    terms : int
        Residual terms of each reference: 1/ω², 1, ω² (in this order of need).
    """

    squared: FloatArray
    values: ComplexArray
    weights: FloatArray
    unit: float
    terms: int = 3

    @property
    def bin(self) -> int:
        """Lines of a bin."""
        return len(self.squared) // self.values.shape[-1]

    @property
    def omega(self) -> FloatArray:
        """Angular frequencies over the root of `unit`, ascending."""
        root: FloatArray = np.sqrt(self.squared)
        return root

    def binned(self, curves: ComplexArray) -> ComplexArray:
        """Curves over `squared`, averaged over the bins."""
        if self.bin == 1:
            return curves
        mean: ComplexArray = curves.reshape(*curves.shape[:-1], self.values.shape[-1], self.bin).mean(axis=-1)
        return mean


@dataclass(frozen=True)
class Modes:
    """Poles and participations, in a window's units.

    Attributes
    ----------
    poles : complex array, shape (modes,)
    parts : complex array, shape (modes, references)
        Participations, the largest component of each equal to 1.
    shift : array, shape (points,), or None
        Relative frequency shift of all poles at every point.
    """

    poles: ComplexArray
    parts: ComplexArray
    shift: FloatArray | None = None

    def __len__(self) -> int:
        return len(self.poles)

    def without(self, index: int) -> Modes:
        return replace(self, poles=np.delete(self.poles, index), parts=np.delete(self.parts, index, axis=0))

    def with_mode(self, pole: complex, part: ComplexArray) -> Modes:
        return replace(
            self, poles=np.append(self.poles, pole), parts=np.concatenate([self.parts, unit_part(part)[None]])
        )


@dataclass(frozen=True)
class Linear:
    """Eliminated unknowns at given poles and what the fit needs of them.

    Attributes
    ----------
    chi2 : array, shape (points,)
        Σ |residual|²/variance.
    coefficients : complex array, shape (points, columns)
        Of the columns (modes, neighbours, residual terms), which were scaled to unit norm.
    inverse : complex array, shape (points, columns, columns)
        Their covariance.
    norms : array, shape (points, columns)
    correlation : float
        Integrated autocorrelation of the weighted residuals along the lines, at least 1: about 1 for noise,
        more where the model misses something smooth.
    """

    chi2: FloatArray
    coefficients: ComplexArray
    inverse: ComplexArray
    norms: FloatArray
    correlation: float = 1.0


def unit_part(part: ComplexArray) -> ComplexArray:
    """Participation scaled to 1 at its largest component."""
    scaled: ComplexArray = part / part[np.argmax(np.abs(part))]
    return scaled


def columns(window: Window, modes: Modes, neighbours: Modes | None) -> ComplexArray:
    """Columns of the linear problem, shape (1 or points, columns, references, lines)."""
    x = window.squared
    references = window.values.shape[1]
    every = [modal_columns(window, modes)]
    if neighbours is not None and len(neighbours):
        every.append(modal_columns(window, neighbours))
    middle = float(x[len(x) // 2])
    span = float(x[-1] - x[0])
    rows = [np.ones_like(x), middle / x, (x - middle) / span][: window.terms]
    residual = np.zeros((1, references * window.terms, references, window.values.shape[-1]), dtype=complex)
    for j in range(references):
        residual[0, j * window.terms : (j + 1) * window.terms, j] = window.binned(
            np.array(rows, dtype=complex)
        )
    every.append(residual)
    points = max(len(part) for part in every)
    return np.concatenate([np.broadcast_to(p, (points, *p.shape[1:])) for p in every], axis=1)


def modal_columns(window: Window, modes: Modes, power: int = 1) -> ComplexArray:
    """L/(s − ω²)^power of every mode, shape (1 or points, modes, references, lines)."""
    poles = modes.poles[None]
    if modes.shift is not None:
        poles = poles * (1 + modes.shift[:, None]) ** 2
    curve = window.binned((poles[..., None] - window.squared) ** -power)
    result: ComplexArray = modes.parts[None, :, :, None] * curve[:, :, None, :]
    return result


def solve_linear(window: Window, phi: ComplexArray) -> Linear:
    """Least squares over the columns at every point."""
    points = len(window.values)
    flat = phi.reshape(len(phi), phi.shape[1], -1)
    weights = window.weights.reshape(points, 1, -1)
    values = window.values.reshape(points, -1)
    weighted = flat.conj() * weights
    gram = weighted @ flat.transpose(0, 2, 1)
    right = (weighted @ values[:, :, None])[..., 0]
    diagonal = np.sqrt(np.maximum(np.einsum("kcc->kc", gram).real, np.finfo(float).tiny))
    gram = gram / (diagonal[:, :, None] * diagonal[:, None, :])
    inverse = np.linalg.pinv(gram, rcond=_RANK, hermitian=True)
    scaled = right / diagonal
    coefficients = np.einsum("kab,kb->ka", inverse, scaled)
    energy = np.sum(weights[:, 0] * np.abs(values) ** 2, axis=1)
    chi2 = energy - np.einsum("ka,ka->k", scaled.conj(), coefficients).real
    return Linear(np.maximum(chi2, 0.0), coefficients, inverse, diagonal)


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
    unscaled = linear.coefficients / linear.norms
    residual = window.values.reshape(points, -1) - (unscaled[:, None] @ flat)[:, 0]
    linear = replace(linear, correlation=residual_correlation(window, residual))
    empty = np.zeros((0, 0), dtype=complex)
    if not len(modes):
        cross = np.zeros((len(linear.chi2), phi.shape[1], 0), dtype=complex)
        return WindowFit(modes, float(linear.chi2.sum()), linear, empty, cross), np.zeros(0, dtype=complex)
    score, inner, cross = _terms(window, modes, phi, linear, residual)
    fit = WindowFit(modes, float(linear.chi2.sum()), linear, inner.sum(axis=0), cross)
    return fit, score.sum(axis=0)


def _terms(
    window: Window, modes: Modes, phi: ComplexArray, linear: Linear, residual: ComplexArray
) -> tuple[ComplexArray, ComplexArray, ComplexArray]:
    """Every point's part of the gradient and the Hessian, and the change of its linear unknowns."""
    derivative, owner = _derivatives(window, modes)
    weights = window.weights.reshape(len(window.values), 1, -1)
    flat_d = derivative.reshape(len(derivative), derivative.shape[1], -1)
    flat = phi.reshape(len(phi), phi.shape[1], -1)
    weighted = flat_d.conj() * weights
    amplitude = (linear.coefficients / linear.norms)[:, owner]
    score = amplitude.conj() * (weighted @ residual[:, :, None])[..., 0]
    d_phi = (weighted @ flat.transpose(0, 2, 1)) / linear.norms[:, None, :]
    moved = linear.inverse @ d_phi.conj().transpose(0, 2, 1)  # (points, columns, unknowns)
    inner = weighted @ flat_d.transpose(0, 2, 1) - d_phi @ moved
    inner = amplitude.conj()[:, :, None] * inner * amplitude[:, None, :]
    return score, inner, -moved * amplitude[:, None, :]


def shift_terms(
    window: Window, modes: Modes, neighbours: Modes | None
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Of every point: χ², half its negative slope and half its curvature over the point's frequency shift."""
    phi = columns(window, modes, neighbours)
    linear = solve_linear(window, phi)
    flat = phi.reshape(len(phi), phi.shape[1], -1)
    residual = window.values.reshape(len(window.values), -1)
    residual = residual - ((linear.coefficients / linear.norms)[:, None] @ flat)[:, 0]
    score, inner, _ = _terms(window, modes, phi, linear, residual)
    count = len(modes)
    shift = np.zeros(len(residual)) if modes.shift is None else modes.shift
    # ∂/∂δ = Σ_m 2 s_m/(1 + δ) ∂/∂s_m
    chain = 2 * modes.poles[None] / (1 + shift[:, None])
    slope = np.einsum("km,km->k", chain.conj(), score[:, :count]).real
    curvature = np.einsum("km,kmn,kn->k", chain.conj(), inner[:, :count, :count], chain).real
    return linear.chi2, slope, curvature


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
    if modes.shift is not None:
        by_pole = by_pole * (1 + modes.shift[:, None, None, None]) ** 2
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


def free_parts(modes: Modes) -> npt.NDArray[np.int_]:
    """(mode, reference) of every participation that is not the fixed 1."""
    fixed = np.argmax(np.abs(modes.parts), axis=1)
    pairs = [(m, j) for m in range(len(modes)) for j in range(modes.parts.shape[1]) if j != fixed[m]]
    return np.array(pairs, dtype=int).reshape(-1, 2)


def _step(fit: WindowFit, gradient: ComplexArray, damping: float) -> ComplexArray:
    size = np.diag(fit.hessian).real
    # an unknown without influence stays where it is
    diagonal = np.sqrt(np.where(size > _RANK * size.max(initial=0.0), size, np.inf))
    scaled = fit.hessian / np.outer(diagonal, diagonal)
    scaled = scaled + damping * np.eye(len(diagonal))
    step: ComplexArray = (
        np.linalg.pinv(scaled, rcond=_RANK, hermitian=True) @ (gradient / diagonal) / diagonal
    )
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
