"""How many modes a window holds: which to drop, which to add.

A mode must raise the likelihood by more than the price of its unknowns (Bayesian information criterion,
Schwarz 1978), bring a shape of its own and be a pole that the window can show.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from statorhom.extraction.modal_model import Modes, Window, steady_modes
from statorhom.extraction.pole_price import dispersion, misfit, price
from statorhom.extraction.pole_search import best_candidates, trial_poles
from statorhom.extraction.window_fit import WindowFit, fit_window

FloatArray = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]

_MOST_NEW = 5  # modes per window and sweep
# Modes that overlap are judged together: beside what is missing, each alone looks like noise.
_AHEAD = 12  # modes that are tried before any is worth its price …
_FALLING = 0.8  # … while one more leaves at most this part of the misfit
_BESIDE = 2.0  # half-power bandwidths within which a doublet's other mode may lie that no stable pole shows
_HOPELESS = 0.3  # of the price: a candidate that promises less before its pole is optimized is left
_OUTSIDE = 0.5  # of a window's width that a pole may lie beyond it
_CANDIDATES = 4  # trial poles whose fits are looked at: the best may be what no mode is
_TRIAL_ITERATIONS = 12  # the sweeps refine what is kept
_SAME_SHAPE = 0.95  # MAC
_FLANK = 10.0  # bandwidths over which a mode's own curve may be inexact …
_LEAST__BESIDE = 0.1  # … by this part
_MODEL_MISFIT = (
    1.5  # from which on the model, not the noise, limits what is explained; then a mode must make up …
)
_LEAST_PRESENCE = 0.2  # … this part of the receptance at its frequency, in half of the FRFs …
_REST = 0.5  # … or leave less than this part of the misfit, …
_NOISE = 4.0  # … and no more than this after all of them


@dataclass(frozen=True)
class _Among:
    """What further modes are sought among, as of `grow`."""

    window: Window
    neighbours: Modes
    stable: ComplexArray
    reach: tuple[float, float]


def drop_doubtful(window: Window, fit: WindowFit, neighbours: Modes) -> WindowFit:
    """Remove, the weakest first, poles that the window cannot show and those that only correct the model."""
    while True:
        impossible = [
            m
            for m in range(len(fit.modes))
            if not plausible(window, fit.modes.poles[m]) or repeats(fit, neighbours, m)
        ]
        faint = [m for m in range(len(fit.modes)) if m not in impossible and not present(window, fit, m)]
        if not (impossible or faint):
            return fit
        worth = _worth(window, fit)
        at_noise = not window.quiet and misfit(window, fit) < _NOISE
        for m in sorted([*impossible, *faint], key=lambda m: worth[m]):
            smaller = fit_window(window, fit.modes.without(m), neighbours)
            if m not in faint or not at_noise or not _explains(smaller, fit):
                break
        else:
            return fit
        fit = smaller


def _explains(smaller: WindowFit, larger: WindowFit) -> bool:
    """Whether one mode more explains most of the misfit: between broad peaks it may be none of the strong ones."""
    return larger.chi2 < _REST * smaller.chi2


def prune(window: Window, fit: WindowFit, neighbours: Modes) -> WindowFit:
    """Remove, the weakest first, modes whose shape does not stand out of its uncertainty."""
    while len(fit.modes):
        worth = _worth(window, fit)
        weakest = int(np.argmin(worth))
        if worth[weakest] > price(window):
            break
        fit = fit_window(window, fit.modes.without(weakest), neighbours)
    return fit


def _worth(window: Window, fit: WindowFit) -> FloatArray:
    """Twice the log likelihood that every mode's shape brings."""
    count = len(fit.modes)
    variance = np.einsum("kcc->kc", fit.linear.inverse).real[:, :count]
    square = np.abs(fit.linear.coefficients[:, :count]) ** 2
    # a point without data in the window has neither coefficient nor variance
    worth: FloatArray = 2 * np.sum(square / np.where(variance > 0, variance, np.inf), axis=0)
    return worth / dispersion(window, fit)


def grow(
    window: Window,
    fit: WindowFit,
    neighbours: Modes,
    stable: ComplexArray,
    reach: tuple[float, float],
    most: int = _MOST_NEW,
) -> WindowFit:
    """Add up to `most` modes while each is worth its price.

    Parameters
    ----------
    stable : complex array, shape (poles,)
        Stable poles of the start estimator, in the window's unit: a mode apart from all others must show among
        them too, for ripples of a real recording can be worth a pole's price.
    reach : (below, above)
        How far beyond the window, in its width, poles are looked for.
    """
    among = _Among(window, neighbours, stable, reach)
    for _ in range(most):
        larger = _larger(among, fit)
        if larger is None:
            break
        fit = larger
    return fit


def _larger(among: _Among, fit: WindowFit) -> WindowFit | None:
    """Fit with one mode more, or several where fewer leave too much misfit to be judged; None for none.

    Where none stands out for itself, faint ones may together explain the data down to the noise.
    """
    found = _worth_their_price(among, fit)
    if found is None and not among.window.quiet and misfit(among.window, fit) > _MODEL_MISFIT:
        found = _worth_their_price(among, fit, faint=True)
    return found


def _worth_their_price(among: _Among, fit: WindowFit, *, faint: bool = False) -> WindowFit | None:
    """Fit with as few modes more as are worth their price together; faint ones have to explain everything."""
    window, most = among.window, _NOISE if faint else np.inf
    smaller = fit
    for added in range(1, _AHEAD + 1):
        larger = _with_candidate(among, smaller, faint=faint)
        if larger is None:
            return None
        worth = 2 * (fit.chi2 - larger.chi2) / dispersion(window, larger)
        if worth >= added * price(window) and misfit(window, larger) < most:
            return larger
        # a mode more explains a good part of what is left as long as some are missing
        if added > 1 and larger.chi2 > _FALLING * smaller.chi2:
            return None
        smaller = larger
    return None


def _with_candidate(among: _Among, fit: WindowFit, *, faint: bool = False) -> WindowFit | None:
    """Fit with the most promising further mode that is physical; None where none is promising.

    Parameters
    ----------
    faint : whether one will do that does not stand out, but explains most of what is left.
    """
    window, neighbours = among.window, among.neighbours
    known = np.concatenate([fit.modes.poles, neighbours.poles])
    trials = trial_poles(window, known, among.reach)
    least = 0.5 * _HOPELESS * price(window) * misfit(window, fit)
    for candidate in best_candidates(window, fit, neighbours, trials, least, _CANDIDATES):
        larger = fit_window(
            window,
            fit.modes.joined(steady_modes(np.array([candidate.pole]), candidate.part[None])),
            neighbours,
            _TRIAL_ITERATIONS,
        )
        physical = all(plausible(window, pole) for pole in larger.modes.poles)
        will_do = faint and _is_inside(window, larger.modes.poles[-1]) and _explains(fit, larger)
        physical = physical and (
            will_do or _stands_out(window, larger, np.concatenate([known, among.stable]))
        )
        if physical and not any(repeats(larger, neighbours, m) for m in range(len(larger.modes))):
            return larger
    return None


def _is_inside(window: Window, pole: complex) -> bool:
    """Whether its whole peak lies in the window: at an end anything may be the flank of something beyond."""
    return bool(window.squared[0] < pole.real - pole.imag and pole.real + pole.imag < window.squared[-1])


def _stands_out(window: Window, larger: WindowFit, expected: ComplexArray) -> bool:
    """Whether the last mode is where others are or the start estimator saw one, and is strong enough there."""
    pole = larger.modes.poles[-1]
    beyond = not window.squared[0] < pole.real < window.squared[-1]
    return (beyond or _near(pole, expected)) and present(window, larger, len(larger.modes) - 1)


def _near(pole: complex, others: ComplexArray) -> bool:
    return bool(np.any(np.abs(others.real - pole.real) < _BESIDE * np.maximum(others.imag, pole.imag)))


def repeats(fit: WindowFit, neighbours: Modes, index: int) -> bool:
    """Whether a mode is but a correction of a stronger one nearby.

    Distinct modes that overlap differ in shape. A pole with its neighbour's shape, within the neighbour's
    bandwidth or far below the neighbour's own curve, is what a frequency that shifts from set-up to set-up or
    a resonance curve that is not exactly rational leaves over.
    """
    poles = np.concatenate([fit.modes.poles, neighbours.poles])
    shapes = (fit.linear.coefficients / fit.linear.norms)[:, : len(poles)]
    size = np.linalg.norm(shapes, axis=0) * np.linalg.norm(
        np.concatenate([fit.modes.parts, neighbours.parts]), axis=1
    )
    strength = size / poles.imag
    norm = np.maximum(np.linalg.norm(shapes, axis=0), np.finfo(float).tiny)
    mac = np.abs(shapes[:, index].conj() @ shapes / norm[index] / norm) ** 2
    distance = np.abs(poles.real - poles[index].real)
    curve = size / np.abs(poles - poles[index].real)
    overlap = distance < np.maximum(poles.imag, poles[index].imag)
    beside = (distance < _FLANK * poles.imag) & (strength[index] < _LEAST__BESIDE * curve)
    stronger = strength > strength[index]
    return bool(np.any((mac > _SAME_SHAPE) & stronger & (overlap | beside)))


def present(window: Window, fit: WindowFit, index: int) -> bool:
    """Whether a mode makes up enough of the receptances at its own frequency.

    Asked only where noise does not explain the misfit: there a pole may stand for anything that the model lacks.
    """
    pole = fit.modes.poles[index]
    inside = window.squared[0] < pole.real < window.squared[-1]
    if not inside or not (window.quiet or misfit(window, fit) > _MODEL_MISFIT):
        return True
    line = int(np.searchsorted(window.squared, pole.real)) // window.bin
    line = min(line, window.values.shape[-1] - 1)
    shape = (fit.linear.coefficients / fit.linear.norms)[:, index]
    part = np.abs(shape[:, None] * fit.modes.parts[index]) / pole.imag
    measured = window.weights[..., line] > 0
    share = part[measured] / np.maximum(np.abs(window.values[..., line])[measured], np.finfo(float).tiny)
    return not share.size or bool(np.median(share) > _LEAST_PRESENCE)


def plausible(window: Window, pole: complex) -> bool:
    """Whether a pole lies in the window and is neither broader than it nor narrower than a line."""
    if pole.real <= 0:
        return False
    omega = window.omega
    frequency, width = np.sqrt(pole.real), np.sqrt(pole.real) * pole.imag / pole.real
    span = float(omega[-1] - omega[0])
    inside = omega[0] - _OUTSIDE * span <= frequency <= omega[-1] + _OUTSIDE * span
    return bool(inside and 0.5 * span / (len(omega) - 1) < width < span)
