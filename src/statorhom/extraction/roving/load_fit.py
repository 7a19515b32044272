"""Maximum-likelihood fit of a sensor's load, cluster by cluster of doublets.

Without the load's denominator D a recording's FRFs are those of the structure alone, whose poles stay and whose
residues are linear: they are eliminated (variable projection, its Jacobian after Kaufman 1975), and Gauss–Newton is
left with a few real unknowns per doublet. The loads of a plane change the FRFs of that plane alone.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from statorhom.extraction.clusters import cluster_lines, clusters, nearest
from statorhom.extraction.modal_model import (
    Linear,
    Window,
    columns,
    fitted,
    modal_columns,
    projected,
    solve_linear,
)
from statorhom.extraction.mode_search import ModeSearch
from statorhom.extraction.roving.load import RovingLoad
from statorhom.extraction.roving.load_unknowns import LoadUnknowns
from statorhom.extraction.roving.plane_poles import NEAREST, alone, single_reference

FloatArray = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]

_ROUNDS, _STEPS, _TRIES = 5, 8, 5
_STEP = 1e-7  # of derivatives: along its valleys the objective hardly falls
_SETTLED = 1e-3  # of χ², and of the loss factor what loads may still change


def fitted_load(search: ModeSearch, load: RovingLoad) -> RovingLoad:
    """Refine loads, splits and damping of all clusters of doublets in turn until none changes the misfit."""
    groups, guess = clusters(load.poles), load
    for _ in range(_ROUNDS):
        before = load.load
        for own in groups:
            noise = max(1.0, float(load.misfit[own].min()))
            load = _fit_cluster(search, load, LoadUnknowns(tuple(own), guess, noise))
        loss = load.poles.imag / load.poles.real
        if np.max(np.abs(load.load - before) / loss[:, None], initial=0.0) < _SETTLED:
            break
    return load


@dataclass(frozen=True, eq=False)
class _Problem:
    """Lines around a cluster and what its fit leaves as it is.

    `others` is the denominator without the cluster's own parts, shape (points, lines); `beside` are the columns of the
    modes that are fitted with it and of residual terms, shape (columns, bins).
    """

    window: Window
    unit: float
    others: ComplexArray
    beside: ComplexArray
    unknowns: LoadUnknowns

    @property
    def squared(self) -> FloatArray:
        return self.window.squared * self.unit

    def denominator(self, load: RovingLoad) -> ComplexArray:
        """Of every point, averaged over the bins, shape (points, bins)."""
        own = np.sum([load.part(m, self.squared) for m in self.unknowns.own], axis=0)
        return self.window.binned(self.others - own)

    def resonances(self, load: RovingLoad) -> ComplexArray:
        """Columns of the cluster's own modes, shape (columns, bins)."""
        return modal_columns(self.window, alone(self.unknowns.halves(load) / self.unit))[0, :, 0]


@dataclass(frozen=True, eq=False)
class _State:
    """Fit at given unknowns: arrays over FRFs and bins, of the freed recording."""

    load: RovingLoad
    denominator: ComplexArray
    flat: ComplexArray
    linear: Linear
    weights: FloatArray
    residual: ComplexArray
    objective: float

    @property
    def freedom(self) -> int:
        return max(int(np.count_nonzero(self.weights)) - self.linear.coefficients.size, 1)

    @property
    def misfit(self) -> float:
        return float(self.linear.chi2.sum()) / self.freedom


def _fit_cluster(search: ModeSearch, load: RovingLoad, unknowns: LoadUnknowns) -> RovingLoad:
    problem, own = _problem(search, load, unknowns), list(unknowns.own)
    first, split = _state(problem, load), unknowns.split(load)
    # the slopes need both columns of a doublet, and so are always those of split ones
    best, normal = _minimized(problem, first if split is load else _state(problem, split))
    if not best.objective < first.objective:
        best = first
    sd = unknowns.load_sd(normal) * np.sqrt(max(best.misfit, 1.0) / 2)
    found = best.load
    return replace(
        found,
        load_sd=_with(found.load_sd, own, sd),
        misfit=_with(found.misfit, own, np.full(len(own), best.misfit)),
    )


def _with(array: FloatArray, rows: list[int], values: FloatArray) -> FloatArray:
    changed = array.copy()
    changed[rows] = values
    return changed


def _problem(search: ModeSearch, load: RovingLoad, unknowns: LoadUnknowns) -> _Problem:
    own = list(unknowns.own)
    lines = cluster_lines(unknowns.places(load) / search.unit, search.omega)
    window = search.window(lines)
    squared = window.squared * search.unit
    parts = np.sum([load.part(m, squared) for m in own], axis=0)
    near = nearest(load.poles / search.unit, own, lines, search.omega, NEAREST)
    halves = np.unique(np.array([load.halves(m) for m in near], dtype=complex).ravel())
    others = load.denominator(squared) + parts
    beside = columns(single_reference(window), alone(halves / search.unit), None)[0, :, 0]
    return _Problem(window, search.unit, others, beside, unknowns)


def _state(problem: _Problem, load: RovingLoad) -> _State:
    window, denominator = problem.window, problem.denominator(load)[:, None]
    freed = single_reference(
        replace(window, values=window.values * denominator, weights=window.weights / np.abs(denominator) ** 2)
    )
    flat = np.concatenate([problem.resonances(load), problem.beside])
    linear = solve_linear(freed, flat[None, :, None])
    rest = freed.values[:, 0] - fitted(linear.coefficients / linear.norms, flat[None])
    kept = problem.unknowns.kept(load)
    objective = float(linear.chi2.sum() + kept @ kept)
    of_frfs = np.repeat(denominator[:, 0], window.values.shape[1], axis=0)
    return _State(load, of_frfs, flat, linear, freed.weights[:, 0], rest, objective)


def _slopes(problem: _Problem, state: _State) -> ComplexArray:
    """Change of the residuals with the unknowns of every mode, those of all planes' loads in one, over `_STEP`.

    Shape (modes · unknowns of one, FRFs, bins), with the linear unknowns eliminated.
    """
    amplitude = state.linear.coefficients / state.linear.norms
    model = amplitude @ state.flat
    references = len(amplitude) // len(problem.window.values)
    own = len(state.flat) - len(problem.beside)
    slopes = []
    for changed in problem.unknowns.steps(state.load, _STEP):
        moved = np.repeat(problem.denominator(changed), references, axis=0)
        wave = amplitude[:, :own] @ (problem.resonances(changed) - state.flat[:own])
        slope = (model * (moved / state.denominator - 1) - wave) / _STEP
        inner = projected(state.flat[None], state.weights * slope) / state.linear.norms
        taken = np.einsum("kab,kb->ka", state.linear.inverse, inner) / state.linear.norms
        slopes.append(slope - taken @ state.flat)
    return np.array(slopes)


def _normal(problem: _Problem, state: _State) -> tuple[FloatArray, FloatArray]:
    """Half the curvature of the objective and half its slope over the unknowns."""
    unknowns, slopes = problem.unknowns, _slopes(problem, state)
    normal, slope = unknowns.prior(state.load)
    references = len(state.residual) // len(problem.window.values)
    plane = np.repeat(state.load.rings.plane, references)
    for z in range(unknowns.planes):
        rows, places = plane == z, unknowns.of_plane(z)
        here = slopes[:, rows].reshape(len(slopes), -1)
        weighed = here.conj() * state.weights[rows].ravel()
        normal[np.ix_(places, places)] += (weighed @ here.T).real
        slope[places] += (weighed @ state.residual[rows].ravel()).real
    return normal, slope


def _minimized(problem: _Problem, state: _State) -> tuple[_State, FloatArray]:
    """Levenberg–Marquardt: the best state, and half the curvature there or one step before."""
    normal, slope = _normal(problem, state)
    damping = 1e-3
    for _ in range(_STEPS):
        accepted = None
        for _ in range(_TRIES):
            lifted = normal + damping * np.diag(np.maximum(np.diag(normal), np.finfo(float).tiny))
            step: FloatArray = -np.linalg.solve(lifted, slope).astype(float)
            trial = _state(problem, problem.unknowns.moved(state.load, step))
            if trial.objective < state.objective:
                accepted = trial
                break
            damping *= 10
        if accepted is None:
            break
        gained = state.objective - accepted.objective
        state, damping = accepted, max(damping / 10, 1e-9)
        if gained < _SETTLED * state.objective:
            break
        normal, slope = _normal(problem, state)
    return state, normal
