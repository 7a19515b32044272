"""What a further mode must bring, and what counts as noise when it is judged."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from statorhom.extraction.modal_model import Window
from statorhom.extraction.set_up_shifts import SetUps
from statorhom.extraction.window_fit import WindowFit

_LEAST_DISPERSION = 0.1  # the noise may be overestimated at sharp peaks, but not by more

FloatArray = npt.NDArray[np.float64]


def price(window: Window) -> float:
    """Twice the log likelihood that a further mode must bring: its pole, participation and shape."""
    points, references, _ = window.values.shape
    return (2 * points + 2 + 2 * (references - 1)) * unknown_price(window)


def unknown_price(window: Window) -> float:
    """Price of one real unknown: the logarithm of the data behind it, those of one point."""
    _, references, lines = window.values.shape
    return float(np.log(2.0 * references * lines))


def set_up_price(window: Window, set_ups: SetUps) -> float:
    """Price of a shift in every set-up, each with the data of its set-up behind it."""
    count = set_ups.count(window)
    return float(count * np.log(2.0 * window.values.size / count))


def misfit(window: Window, fit: WindowFit) -> float:
    """Mean squared weighted residual per degree of freedom: 1 where the noise explains it."""
    data = int(np.count_nonzero(window.weights))
    unknowns = fit.linear.coefficients.size + 2 * len(fit.modes)
    unknowns += int(np.count_nonzero(fit.modes.shift)) // 2
    return max(_LEAST_DISPERSION, fit.chi2 / max(data - unknowns, 1))


def dispersion(window: Window, fit: WindowFit) -> float:
    """Misfit per independent degree of freedom: what counts as variance of the noise.

    Misfit that the noise does not explain is smooth along the lines; lines that agree with their neighbours
    in it are not independent evidence for a mode.
    """
    return misfit(window, fit) * fit.linear.correlation


def worth(window: Window, fit: WindowFit) -> FloatArray:
    """Twice the log likelihood that every mode's shape brings."""
    count = len(fit.modes)
    variance = np.einsum("kcc->kc", fit.linear.inverse).real[:, :count]
    square = np.abs(fit.linear.coefficients[:, :count]) ** 2
    # a point without data in the window has neither coefficient nor variance
    brought: FloatArray = 2 * np.sum(square / np.where(variance > 0, variance, np.inf), axis=0)
    return brought / dispersion(window, fit)
