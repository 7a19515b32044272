"""Whether the poles of a test move from set-up to set-up, and which modes of a window do.

The Bayesian information criterion decides between several modes that stay and fewer that move.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import numpy.typing as npt

from statorhom.extraction.modal_model import Modes, Window, unit_part
from statorhom.extraction.mode_count import grow
from statorhom.extraction.pole_price import dispersion, misfit, price, set_up_price
from statorhom.extraction.set_up_shifts import SetUps, fit_shifted, shift_gains
from statorhom.extraction.window_fit import WindowFit, fit_window

FloatArray = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]

_EXPLAINED = 1.5  # misfit of a window that needs nothing further
_STEADY = 0.5  # of the price of shifts: what a window may promise whose modes stay
_MAJORITY = 2.0  # windows with moving modes for every one whose modes stay
_JURY = 4  # windows after which poles that do not move are held still
_IMAGES_COUNT = 3  # windows that one with images counts for
_APART = 0.3  # common part of the amplitudes of two images
_OVERLAP = 3.0  # bandwidths within which images of one moving mode lie
_MOST_BESIDE = 3  # modes that stay beside those that move
_BROAD = 0.02  # loss factor from which on resonances overlap by more than any sensor moves them

FittedWindows = Sequence[tuple[Window, WindowFit, Modes]]  # with the neighbours


def moving_set_ups(windows: FittedWindows) -> SetUps | None:
    """What the poles move with, if they move in most windows; None for a test whose poles stay.

    One doublet that is barely split looks like a mode that moves. Set-ups that differ move most modes. Broad resonances
    that overlap look like fewer that move.
    """
    best, most = None, 0
    fitted = [one for one in windows if len(one[1].modes) and not _is_broad(one[1])]
    for set_ups in SetUps:
        seen = [_in_pairs(*one, set_ups) for one in fitted if set_ups.count(one[0]) > 1]
        gains = [float(np.max(_promises(*one, set_ups))) for one in seen]
        images = [set_ups is SetUps.POINTS and _has_images(fit) for _, fit, _ in seen]
        steady = sum(
            gain < _STEADY and misfit(window, fit) < _EXPLAINED and not image
            for gain, image, (window, fit, _) in zip(gains, images, seen, strict=True)
        )
        moving = sum(
            max(gain > 1.0, _IMAGES_COUNT * image) for gain, image in zip(gains, images, strict=True)
        )
        if moving > _MAJORITY * steady and moving > most:
            best, most = set_ups, moving
    return best


def stay(windows: FittedWindows) -> bool:
    """Whether modes that stay where they are explain a recording, and nothing of it looks like a move any more.

    No in a few windows: two poles that stay explain one that moves a little as well.

    Parameters
    ----------
    windows : after a search for modes that stay.
    """
    fitted = [one for one in windows if len(one[1].modes)]
    if len(fitted) < _JURY or moving_set_ups(fitted) is not None:
        return False
    return all(_explained(window, fit) for window, fit, _ in fitted)


def few_stay(windows: FittedWindows) -> bool:
    """Whether modes that stay explain so few windows that the search for them had better end.

    Parameters
    ----------
    windows : after its first sweep: what that leaves, further ones share out among more modes.
    """
    explained = [_explained(window, fit) for window, fit, _ in windows if len(fit.modes)]
    return 2 * sum(explained) < len(explained)


def _explained(window: Window, fit: WindowFit) -> bool:
    """Whether modes that stay explain a window, none of which is another one's image."""
    return misfit(window, fit) < _EXPLAINED and not _has_images(fit)


def _is_broad(fit: WindowFit) -> bool:
    """Whether a window's resonances are too broad to tell a pole that moves from two that overlap."""
    return bool(np.median(fit.modes.loss_factors) > _BROAD)


def most_move(windows: Sequence[bool]) -> bool:
    """Whether what a look from afar has promised holds in the windows that were searched; yes while these are few.

    Parameters
    ----------
    windows : of every window, whether it is explained best by modes that move.
    """
    moving = sum(windows)
    return len(windows) < _JURY or _MAJORITY * moving >= len(windows) - moving


def _has_images(fit: WindowFit) -> bool:
    """Whether two poles that overlap show at different points: one mode in two places, exactly explained."""
    poles, count = fit.modes.poles, len(fit.modes)
    size = np.abs(fit.linear.unscaled[:, :count])
    unit = size / np.maximum(np.linalg.norm(size, axis=0), np.finfo(float).tiny)
    apart = unit.T @ unit < _APART
    near = np.abs(poles.real[:, None] - poles.real[None]) < _OVERLAP * np.minimum(
        poles.imag[:, None], poles.imag
    )
    return bool(np.any(apart & near))


def _promises(window: Window, fit: WindowFit, neighbours: Modes, set_ups: SetUps) -> FloatArray:
    gains = shift_gains(window, fit, neighbours, set_ups)
    promises: FloatArray = 2 * gains / dispersion(window, fit) / set_up_price(window, set_ups)
    return promises


def with_moving_modes(
    window: Window, fit: WindowFit, neighbours: Modes, set_ups: SetUps, stable: ComplexArray
) -> WindowFit:
    """The fit itself, or one that starts anew from its distinct modes, moving, where that is the better bargain.

    Parameters
    ----------
    stable : complex array, shape (poles,)
        As in `grow`.
    """
    if not len(fit.modes) or fit.modes.moving.any() or _is_broad(fit):
        return fit
    apart = distinct(fit)
    promising = np.max(_promises(*_in_pairs(window, fit, neighbours, set_ups), set_ups)) > 1.0
    if not promising and len(apart) == len(fit.modes):
        return fit
    modes = fit.modes.of(apart)
    trial = fit_shifted(window, modes, neighbours, np.ones(len(modes), dtype=bool), set_ups)
    if set_ups is SetUps.REFERENCES:
        trial = _damped(window, trial, neighbours, set_ups)
    else:
        trial = _doubled(window, trial, neighbours)
    for _ in range(_MOST_BESIDE):
        larger = grow(window, trial, neighbours, stable, (0.0, 0.0), most=1)
        if len(larger.modes) == len(trial.modes):
            break
        # what the new mode explains is no shift any more
        trial = refitted(window, larger.modes, neighbours, set_ups)
    return _cheaper(window, trial, fit)


def _doubled(window: Window, fit: WindowFit, neighbours: Modes) -> WindowFit:
    """Two modes in the place of each, where that is the better bargain: a sensor moves both modes of a doublet.

    At every point the sensor makes another of their sums the lower mode; several references tell the two apart.
    """
    if window.values.shape[1] < 2:
        return fit
    pairs = _paired(fit.modes)
    return _cheaper(window, fit_shifted(window, pairs, neighbours, pairs.moving, SetUps.POINTS), fit)


def _in_pairs(
    window: Window, fit: WindowFit, neighbours: Modes, set_ups: SetUps
) -> tuple[Window, WindowFit, Modes]:
    """The same with two modes that stay in the place of each, where that is the better bargain.

    The first look takes a doublet for one mode; what its partner leaves would hide that a sensor moves both of them.
    """
    if set_ups is SetUps.POINTS and window.values.shape[1] > 1:
        fit = _cheaper(window, fit_window(window, _paired(fit.modes), neighbours), fit)
    return window, fit, neighbours


def _paired(modes: Modes) -> Modes:
    """Every mode with one of the same pole and another participation."""
    parts = np.array([_other_part(part) for part in modes.parts])
    return modes.joined(replace(modes, parts=parts))


def _other_part(part: ComplexArray) -> ComplexArray:
    """A participation that has nothing in common with a given one."""
    unit = np.zeros(len(part), dtype=complex)
    unit[np.argmin(np.abs(part))] = 1.0
    return unit_part(unit - part * (part.conj() @ unit) / np.sum(np.abs(part) ** 2))


def distinct(fit: WindowFit) -> list[int]:
    """Modes without those that overlap with a stronger one: a mode that moves has left several images."""
    poles = fit.modes.poles
    amplitude = fit.linear.unscaled[:, : len(poles)]
    strength = np.linalg.norm(amplitude, axis=0) / poles.imag
    kept: list[int] = []
    for m in np.argsort(-strength).tolist():
        if all(abs(poles[m].real - poles[other].real) > _OVERLAP * poles[other].imag for other in kept):
            kept.append(m)
    return sorted(kept)


def _damped(window: Window, fit: WindowFit, neighbours: Modes, set_ups: SetUps) -> WindowFit:
    """Also the damping may move: from hammer point to hammer point supports settle, but a mass damps nothing."""
    trial = fit_shifted(window, fit.modes, neighbours, fit.modes.moving, set_ups, damped=True)
    return _cheaper(window, trial, fit)


def _cheaper(window: Window, trial: WindowFit, fit: WindowFit) -> WindowFit:
    return trial if _cost(window, trial, fit) < _cost(window, fit, trial) else fit


def refitted(window: Window, modes: Modes, neighbours: Modes, set_ups: SetUps | None) -> WindowFit:
    """Fit with the modes that moved before moving on."""
    if set_ups is None:
        return fit_window(window, modes, neighbours)
    damped = bool(np.any(modes.shift.imag != 0))
    return fit_shifted(window, modes, neighbours, modes.moving, set_ups, damped)


def _cost(window: Window, fit: WindowFit, other: WindowFit) -> float:
    """BIC, with the smaller misfit of the two fits as noise."""
    noise = min(dispersion(window, fit), dispersion(window, other))
    shift = fit.modes.shift
    free = np.count_nonzero(shift.real) + np.count_nonzero(shift.imag)
    set_ups = max(1, shift.shape[0] * shift.shape[2])
    shifts = free / set_ups * set_up_price(window, SetUps.POINTS if shift.shape[0] > 1 else SetUps.REFERENCES)
    return 2 * fit.chi2 / noise + len(fit.modes) * price(window) + shifts
