"""Maximum-likelihood fit of a sensor's load, doublet by doublet.

With the denominator of the load a recording's FRFs are those of the structure without it, whose poles stay and whose
residues are linear: they are eliminated, and Gauss–Newton is left with a few real unknowns per doublet.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np
import numpy.typing as npt

from statorhom.extraction.clusters import cluster_lines
from statorhom.extraction.modal_model import Window, columns, fitted, solve_linear
from statorhom.extraction.mode_search import ModeSearch
from statorhom.extraction.roving.load import RovingLoad
from statorhom.extraction.roving.plane_poles import alone, nearest_modes, single_reference

FloatArray = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]
Residual = Callable[[FloatArray], tuple[ComplexArray, int]]

_ROUNDS, _STEPS, _TRIES = 3, 8, 4
_STEP = 1e-5  # of derivatives
_FIRST_SPLIT = 0.03  # of the loss factor
_SETTLED = 1e-3  # of χ²
_PLACE = 0.5  # of the mean load: standard deviation of a doublet's place from its first guess
_LARGEST_SPLIT, _LARGEST_LOAD = 0.02, 0.2


def fitted_load(search: ModeSearch, load: RovingLoad) -> RovingLoad:
    """Refine loads, splits and damping of all doublets in turn until none changes the misfit."""
    for _ in range(_ROUNDS):
        before = load.load
        for mode in range(len(load)):
            load = _fit_mode(search, load, mode)
        loss = load.poles.imag / load.poles.real
        if np.max(np.abs(load.load - before) / loss[:, None], initial=0.0) < _SETTLED:
            break
    return load


def _fit_mode(search: ModeSearch, load: RovingLoad, mode: int) -> RovingLoad:
    residual = _residual(search, load, mode)
    start = _unknowns(load, mode)
    first, freedom = residual(start)
    if load.orders[mode] > 0 and not load.split[mode].any():
        # two equal poles are one column
        start[-2:] = _FIRST_SPLIT * load.poles[mode].imag / load.poles[mode].real / np.sqrt(2)
    x, chi2, normal = _minimized(residual, start, partial(_is_physical, load))
    if not chi2 < np.vdot(first, first).real:
        return replace(load, misfit=_with(load.misfit, mode, np.vdot(first, first).real / freedom))
    load = _with_unknowns(load, mode, x)
    planes = load.load.shape[1]
    # of the loads against each other: with the place all of them change alike
    others = np.delete(np.arange(len(x)), planes + 1)
    covariance = np.linalg.pinv(normal[np.ix_(others, others)], hermitian=True)
    sd = np.sqrt(np.diag(covariance)[:planes] * max(chi2 / freedom, 1.0) / 2)
    return replace(
        load, load_sd=_with(load.load_sd, mode, sd), misfit=_with(load.misfit, mode, chi2 / freedom)
    )


def _unknowns(load: RovingLoad, mode: int) -> FloatArray:
    """Loads of the planes, loss factor, relative change of the place and, of doublets, the split."""
    loss = load.poles[mode].imag / load.poles[mode].real
    split = load.split[mode] if load.orders[mode] > 0 else np.zeros(0)
    return np.concatenate([load.load[mode], [loss, 0.0], split])


def _with_unknowns(load: RovingLoad, mode: int, x: FloatArray) -> RovingLoad:
    planes = load.load.shape[1]
    split = x[planes + 2 :] if load.orders[mode] > 0 else np.zeros(2)
    return replace(
        load,
        load=_with(load.load, mode, x[:planes]),
        poles=_with(load.poles, mode, load.poles[mode].real * (1 + x[planes + 1]) * (1 + 1j * x[planes])),
        split=_with(load.split, mode, split),
    )


def _is_physical(load: RovingLoad, x: FloatArray) -> bool:
    planes = load.load.shape[1]
    loads, loss, split = x[:planes], x[planes], x[planes + 2 :]
    return bool(
        loads.min() > 0
        and loads.max() < _LARGEST_LOAD
        and loss > 0
        and np.linalg.norm(split) < _LARGEST_SPLIT
    )


def _with(array: npt.NDArray, row: int, value: object) -> npt.NDArray:
    changed = array.copy()
    changed[row] = value
    return changed


def _residual(search: ModeSearch, load: RovingLoad, mode: int) -> Residual:
    """Weighted residuals around one mode and their degrees of freedom, as a function of its unknowns."""
    lines = cluster_lines(_places(load, mode) / search.unit, search.omega)
    window = search.window(lines)
    squared = window.squared * search.unit
    others = load.denominator(squared) + load.part(mode, squared)
    halves = [load.halves(m) for m in nearest_modes(load.poles, [mode])]
    beside = alone(np.unique(np.array(halves).ravel()) / search.unit)
    planes = load.load.shape[1]

    def residual(x: FloatArray) -> tuple[ComplexArray, int]:
        changed = _with_unknowns(load, mode, x)
        own = alone(np.unique(changed.halves(mode)) / search.unit)
        freed = single_reference(_freed(window, others - changed.part(mode, squared)))
        phi = columns(freed, own, beside)
        linear = solve_linear(freed, phi)
        flat = phi.reshape(1, phi.shape[1], -1)
        rest = freed.values.reshape(len(freed.values), -1) - fitted(linear.coefficients / linear.norms, flat)
        rest = rest * np.sqrt(freed.weights.reshape(len(freed.values), -1))
        # only a split tells where a doublet lies without the sensor
        kept = x[planes + 1] / (_PLACE * load.load[mode].mean())
        return np.append(rest.ravel(), kept), max(
            int(np.count_nonzero(freed.weights)) - linear.coefficients.size, 1
        )

    return residual


def _places(load: RovingLoad, mode: int) -> ComplexArray:
    """Where the mode's poles lie, with and without the sensor."""
    pole = load.poles[mode]
    return np.array([pole, *(pole / (1 + load.load[mode]))])


def _freed(window: Window, denominator: ComplexArray) -> Window:
    mean = window.binned(denominator)[:, None]
    return replace(window, values=window.values * mean, weights=window.weights / np.abs(mean) ** 2)


def _minimized(
    residual: Residual, x: FloatArray, allowed: Callable[[FloatArray], bool]
) -> tuple[FloatArray, float, FloatArray]:
    """Levenberg–Marquardt with differences: unknowns, χ² and half its curvature."""
    rest, _ = residual(x)
    chi2, damping = np.vdot(rest, rest).real, 1e-3
    for _ in range(_STEPS):
        steps = _STEP * np.eye(len(x))
        slopes = np.array([(residual(x + step)[0] - rest) / _STEP for step in steps])
        normal, gradient = (slopes.conj() @ slopes.T).real, (slopes.conj() @ rest).real
        accepted = None
        for _ in range(_TRIES):
            trial = x - np.linalg.solve(normal + damping * np.diag(np.diag(normal)), gradient)
            found = residual(trial)[0] if allowed(trial) else np.full_like(rest, np.inf)
            if np.vdot(found, found).real < chi2:
                accepted = trial, found
                break
            damping *= 10
        if accepted is None:
            break
        gained = chi2 - np.vdot(accepted[1], accepted[1]).real
        x, rest = accepted
        chi2, damping = chi2 - gained, max(damping / 10, 1e-9)
        if gained < _SETTLED * chi2:
            break
    return x, float(chi2), normal
