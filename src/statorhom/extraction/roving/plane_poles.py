"""Poles of every measuring plane: a sensor moves a doublet alike all around it, its antinode always at the sensor."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from statorhom.extraction.clusters import cluster_lines, clusters, nearest
from statorhom.extraction.modal_model import Modes, Window, columns, solve_linear, steady_modes
from statorhom.extraction.mode_search import ModeSearch
from statorhom.extraction.roving.rings import Rings
from statorhom.extraction.window_fit import fit_window

FloatArray = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]
IntArray = npt.NDArray[np.int_]

NEAREST = 6
"""Modes on each side of a window that are fitted with its own."""

_STARTS = np.linspace(-1.5, 1.5, 13)  # half-power bandwidths
_ROUNDS = 5
_SETTLED = 0.003  # bandwidths that a pole may still move


@dataclass(frozen=True, eq=False)
class PlanePoles:
    """Poles of the same modes in every plane.

    Attributes
    ----------
    poles : complex array, shape (planes, modes)
        In units of the search.
    residues : complex array, shape (points, references, modes)
        In units of the search.
    misfit : array, shape (planes, modes)
        Mean squared residual over the noise, of the window around each mode.
    """

    poles: ComplexArray
    residues: ComplexArray
    misfit: FloatArray


def single_reference(window: Window) -> Window:
    """Every FRF of a window as a point of its own: nothing but poles is shared."""
    shape = (window.values.shape[0] * window.values.shape[1], 1, -1)
    return replace(window, values=window.values.reshape(shape), weights=window.weights.reshape(shape))


def alone(poles: npt.ArrayLike) -> Modes:
    """Modes of FRFs that share nothing but poles."""
    found = np.asarray(poles, dtype=complex)
    return steady_modes(found, np.ones((len(found), 1), dtype=complex))


def plane_poles(search: ModeSearch, start: ComplexArray, rings: Rings) -> PlanePoles:
    """Fit the poles of every plane, cluster by cluster, with the neighbours where they are in that plane.

    Parameters
    ----------
    search : of the recording; gives windows of lines.
    start : complex array, shape (modes,) or (planes, modes)
        A pole of every mode, wherever the first look found it, or in every plane.
    """
    planes, points = len(rings.heights_m), len(rings.plane)
    state = PlanePoles(
        np.array(np.broadcast_to(start, (planes, start.shape[-1]))),
        np.zeros((points, len(search.grid.references), start.shape[-1]), dtype=complex),
        np.ones((planes, start.shape[-1])),
    )
    groups = clusters(state.poles.mean(axis=0))
    for number in range(_ROUNDS):
        before = state.poles.copy()
        for own in groups:
            _fit_cluster(search, rings, state, own, scan=number == 0 and start.ndim == 1)
        if np.max(np.abs(state.poles - before) / before.imag, initial=0.0) < _SETTLED:
            break
    return state


def _fit_cluster(search: ModeSearch, rings: Rings, state: PlanePoles, own: list[int], scan: bool) -> None:
    lines = cluster_lines(state.poles[:, own].mean(axis=0), search.omega)
    window = search.window(lines)
    for z, rows in enumerate(rings.members):
        here = single_reference(replace(window, values=window.values[rows], weights=window.weights[rows]))
        beside = alone(state.poles[z, nearest(state.poles[z], own, lines, search.omega, NEAREST)])
        start = state.poles[z, own]
        fit = fit_window(here, alone(_scanned(here, start, beside) if scan else start), beside)
        state.poles[z, own] = fit.modes.poles
        residues = (fit.linear.coefficients / fit.linear.norms)[:, : len(own)]
        shaped = residues.reshape(len(rows), -1, len(own))
        for number, mode in enumerate(own):
            state.residues[rows, :, mode] = shaped[..., number]
        freedom = max(int(np.count_nonzero(here.weights)) - fit.linear.coefficients.size, 1)
        state.misfit[z, own] = fit.chi2 / freedom


def _scanned(window: Window, start: ComplexArray, beside: Modes) -> ComplexArray:
    """The best of a row of starts, mode by mode."""
    best = start.copy()
    for m, pole in enumerate(start):
        found = []
        for step in _STARTS:
            trial = best.copy()
            trial[m] = pole * (1 + 0.5 * step * pole.imag / pole.real) ** 2
            chi2 = solve_linear(window, columns(window, alone(trial), beside)).chi2.sum()
            found.append((float(chi2), trial[m]))
        best[m] = min(found, key=lambda one: one[0])[1]
    return best
