"""Poles of a fit that are no modes: beyond what a window can show, or corrections of what the model lacks."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from statorhom.extraction.modal_model import Modes, Window
from statorhom.extraction.pole_price import misfit, worth
from statorhom.extraction.window_fit import WindowFit, fit_window

ComplexArray = npt.NDArray[np.complex128]

MODEL_MISFIT = 1.5
"""Misfit from which on the model, not the noise, may limit what is explained."""

_OUTSIDE = 0.5  # of a window's width that a pole may lie beyond it
_SAME_SHAPE = 0.95  # MAC
_SECOND_SHAPE = 0.1  # of the first, in what two poles of one place bring together: more is a doublet …
_SECOND_SHAPE_AT_NOISE = 0.02  # … and this is where no ripple of the recording is left to explain
_ONE_PLACE = 0.2  # bandwidths
_FLANK = 10.0  # bandwidths over which a mode's own curve may be inexact …
_LEAST_BESIDE = 0.1  # … by this part
_LEAST_PRESENCE = 0.2  # of the receptance at a mode's frequency that it makes up, in half of the FRFs, …
_REST = 0.5  # … or it leaves less than this part of the misfit, …
_NOISE = 4.0  # … and no more than this after all


def drop_doubtful(window: Window, fit: WindowFit, neighbours: Modes) -> WindowFit:
    """Remove, the weakest first, poles that the window cannot show and those that only correct the model."""
    while True:
        impossible = [
            m
            for m in range(len(fit.modes))
            if not plausible(window, fit.modes.poles[m]) or repeats(window, fit, neighbours, m)
        ]
        faint = [m for m in range(len(fit.modes)) if m not in impossible and not present(window, fit, m)]
        if not (impossible or faint):
            return fit
        brought = worth(window, fit)
        at_noise = _at_noise(window, fit)
        for m in sorted([*impossible, *faint], key=lambda m: brought[m]):
            smaller = fit_window(window, fit.modes.without(m), neighbours)
            if m not in faint or not at_noise or not explains_most(smaller, fit):
                break
        else:
            return fit
        fit = smaller


def explains_most(smaller: WindowFit, larger: WindowFit) -> bool:
    """Whether one mode more explains most of the misfit: between broad peaks it may be none of the strong ones."""
    return larger.chi2 < _REST * smaller.chi2


def repeats(window: Window, fit: WindowFit, neighbours: Modes, index: int) -> bool:
    """Whether a mode is but a correction of a stronger one nearby.

    Distinct modes that overlap differ in shape. A pole with its neighbour's shape, within the neighbour's
    bandwidth or far below the neighbour's own curve, is what a frequency that shifts from set-up to set-up or
    a resonance curve that is not exactly rational leaves over. So is a further pole in one place, of a shape that
    as many as there are references have already.
    """
    poles = np.concatenate([fit.modes.poles, neighbours.poles])
    parts = np.concatenate([fit.modes.parts, neighbours.parts])
    shapes = fit.linear.unscaled[:, : len(poles)]
    length = np.linalg.norm(shapes, axis=0)
    size = length * np.linalg.norm(parts, axis=1)
    strength = size / poles.imag
    norm = np.maximum(length, np.finfo(float).tiny)
    mac = np.abs(shapes[:, index].conj() @ shapes / norm[index] / norm) ** 2
    distance = np.abs(poles.real - poles[index].real)
    curve = size / np.abs(poles - poles[index].real)
    overlap = distance < np.maximum(poles.imag, poles[index].imag)
    beside = (distance < _FLANK * poles.imag) & (strength[index] < _LEAST_BESIDE * curve)
    stronger = strength > strength[index]
    crowd = stronger & (distance < _ONE_PLACE * poles.imag)
    if np.count_nonzero(crowd) >= parts.shape[1] and _within(shapes[:, index], shapes[:, crowd]):
        return True
    alike = (mac > _SAME_SHAPE) & stronger
    if np.any(alike & beside & ~overlap):
        return True
    return any(
        _is_one_shape(window, fit, shapes[:, [index, other]], parts[[index, other]])
        for other in np.flatnonzero(alike & overlap).tolist()
    )


def _within(shape: ComplexArray, others: ComplexArray) -> bool:
    """Whether a shape is made of others; as many references as these tell no further mode in their place."""
    basis, _ = np.linalg.qr(others)
    inside = np.linalg.norm(basis.conj().T @ shape) ** 2
    return bool(inside > _SAME_SHAPE * np.linalg.norm(shape) ** 2)


def _is_one_shape(window: Window, fit: WindowFit, shapes: ComplexArray, parts: ComplexArray) -> bool:
    """Whether two poles of one place bring hardly more than one shape together.

    Of a doublet that does not split any two shapes of its plane fit, almost equal ones too: what is no matter of
    choice is the sum of their residues. One reference shows one shape of it alone.
    """
    values = np.linalg.svd(shapes @ parts, compute_uv=False)
    second = values[1] / values[0] if len(values) > 1 and values[0] > 0 else 0.0
    return bool(second < (_SECOND_SHAPE_AT_NOISE if _at_noise(window, fit) else _SECOND_SHAPE))


def _at_noise(window: Window, fit: WindowFit) -> bool:
    """Whether noise explains what a fit leaves."""
    return not window.quiet and misfit(window, fit) < _NOISE


def present(window: Window, fit: WindowFit, index: int) -> bool:
    """Whether a mode makes up enough of the receptances at its own frequency.

    Asked only where noise does not explain the misfit: there a pole may stand for anything that the model lacks.
    """
    pole = fit.modes.poles[index]
    inside = window.squared[0] < pole.real < window.squared[-1]
    if not inside or not (window.quiet or misfit(window, fit) > MODEL_MISFIT):
        return True
    line = int(np.searchsorted(window.squared, pole.real)) // window.bin
    line = min(line, window.values.shape[-1] - 1)
    shape = fit.linear.unscaled[:, index]
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
