"""How many modes a window holds: which to add, and which are not worth their unknowns.

A mode must raise the likelihood by more than the price of its unknowns (Bayesian information criterion,
Schwarz 1978), bring a shape of its own and be a pole that the window can show.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from statorhom.extraction.doubtful_modes import MODEL_MISFIT, explains_most, plausible, present, repeats
from statorhom.extraction.modal_model import Modes, Window, steady_modes
from statorhom.extraction.pole_price import dispersion, misfit, price, worth
from statorhom.extraction.pole_search import best_candidates, trial_poles
from statorhom.extraction.window_fit import WindowFit, fit_window

ComplexArray = npt.NDArray[np.complex128]

_MOST_NEW = 5  # modes per window and sweep
# Modes that overlap are judged together: beside what is missing, each alone looks like noise.
_AHEAD = 12  # modes that are tried before any is worth its price …
_FALLING = 0.8  # … while one more leaves at most this part of what is left beyond noise
_EXPLAINED = 1.3  # misfit down to which modes explain the data that do not stand out for themselves
_BESIDE = 2.0  # half-power bandwidths within which a doublet's other mode may lie that no stable pole shows
_HOPELESS = 0.3  # of the price: a candidate that promises less before its pole is optimized is left
_CANDIDATES = 4  # trial poles whose fits are looked at: the best may be what no mode is
_TRIAL_ITERATIONS = 12  # the sweeps refine what is kept


@dataclass(frozen=True)
class _Among:
    """What further modes are sought among, as of `grow`."""

    window: Window
    neighbours: Modes
    stable: ComplexArray
    reach: tuple[float, float]


def prune(window: Window, fit: WindowFit, neighbours: Modes) -> WindowFit:
    """Remove, the weakest first, modes whose shape does not stand out of its uncertainty."""
    while len(fit.modes):
        brought = worth(window, fit)
        weakest = int(np.argmin(brought))
        if brought[weakest] > price(window):
            break
        fit = fit_window(window, fit.modes.without(weakest), neighbours)
    return fit


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
        larger = _worth_their_price(among, fit)
        if larger is None:
            break
        fit = larger
    return fit


def grown_to_noise(
    window: Window,
    fit: WindowFit,
    neighbours: Modes,
    stable: ComplexArray,
    reach: tuple[float, float],
) -> WindowFit:
    """Fit with as many modes more as it takes until noise explains what is left; as it was where none get there.

    Where broad modes overlap none need stand out for itself, beside one that does.

    Parameters
    ----------
    stable, reach : as of `grow`.
    """
    if not len(fit.modes) or window.quiet or misfit(window, fit) < MODEL_MISFIT:
        return fit
    return _worth_their_price(_Among(window, neighbours, stable, reach), fit, faint=True) or fit


def _worth_their_price(among: _Among, fit: WindowFit, *, faint: bool = False) -> WindowFit | None:
    """Fit with as many modes more as are worth their price together; faint ones have to explain everything."""
    window, most = among.window, _EXPLAINED if faint else np.inf
    smaller = fit
    for added in range(1, _AHEAD + 1):
        larger = _with_candidate(among, smaller, faint=faint)
        if larger is None:
            return None
        gained = 2 * (fit.chi2 - larger.chi2) / dispersion(window, larger)
        if gained >= added * price(window) and misfit(window, larger) < most:
            return larger
        # a mode more explains a good part of what is left as long as some are missing
        if added > 1 and not _explains_much(window, smaller, larger):
            return None
        smaller = larger
    return None


def _explains_much(window: Window, smaller: WindowFit, larger: WindowFit) -> bool:
    """Whether one mode more explains a good part of what is left beyond noise."""
    noise = smaller.chi2 / misfit(window, smaller)
    return larger.chi2 - noise < _FALLING * (smaller.chi2 - noise)


def _with_candidate(among: _Among, fit: WindowFit, *, faint: bool = False) -> WindowFit | None:
    """Fit with the most promising further mode that is physical; None where none is promising.

    Parameters
    ----------
    faint : whether one will do that does not stand out, but explains a good part of what is left.
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
        if not all(plausible(window, pole) for pole in larger.modes.poles):
            continue
        will_do = _is_expected(window, larger, np.concatenate([known, among.stable]))
        if faint:
            will_do = explains_most(fit, larger) or (will_do and _explains_much(window, fit, larger))
        else:
            will_do = will_do and present(window, larger, len(larger.modes) - 1)
        if will_do and not any(repeats(window, larger, neighbours, m) for m in range(len(larger.modes))):
            return larger
    return None


def _is_expected(window: Window, larger: WindowFit, expected: ComplexArray) -> bool:
    """Whether the last mode is where others are, or the start estimator saw one, or beyond the window."""
    pole = larger.modes.poles[-1]
    beyond = not window.squared[0] < pole.real < window.squared[-1]
    return beyond or _is_beside(pole, expected)


def _is_beside(pole: complex, others: ComplexArray) -> bool:
    return bool(np.any(np.abs(others.real - pole.real) < _BESIDE * np.maximum(others.imag, pole.imag)))
