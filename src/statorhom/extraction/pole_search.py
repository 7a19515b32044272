"""Where one more pole would explain most of what a fit left over.

For a pole at a trial place the gain in χ² from free residues at all points and references follows from
linear least squares alone, so a whole grid of trial frequencies and loss factors is scored at once.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import numpy.typing as npt

from statorhom.extraction.modal_model import (
    Linear,
    Modes,
    Window,
    columns,
    fitted,
    solve_linear,
    weighted_products,
)
from statorhom.extraction.window_fit import WindowFit

FloatArray = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]
IntArray = npt.NDArray[np.int_]

_OFFSETS = (-1.0, -0.4, -0.1, 0.0, 0.1, 0.4, 1.0)  # of trial poles beside known ones, in bandwidths
_LEAST_NEW = 1e-6  # part of a column that must lie outside the known columns; rounding leaves less
_LARGEST_LOSS = 0.5
_LINES_PER_BANDWIDTH = 1.5  # a narrower pole cannot be told from one bad line
_LOSS_STEP = 3.0  # trial loss factors; a trial pole half a bandwidth off still finds its mode
_CHUNK = 48
_SURPRISE = 2.0  # times what it promises where points are weighted alike: so much a trial may gain


@dataclass(frozen=True)
class Candidate:
    """A trial pole: its place, the participation that suits it best and the gain in χ² it promises."""

    pole: complex
    part: ComplexArray
    gain: float


def trial_poles(window: Window, known: ComplexArray, reach: tuple[float, float] = (0.0, 0.0)) -> ComplexArray:
    """Grid of trial poles over a window, widened by `reach` of its width below and above, and beside known poles."""
    omega = window.omega
    width = float(omega[-1] - omega[0])
    spacing = width / (len(omega) - 1) * window.bin
    low, high = max(float(omega[0]) - reach[0] * width, spacing), float(omega[-1]) + reach[1] * width
    middle = float(omega[len(omega) // 2])
    least = _LINES_PER_BANDWIDTH * spacing / middle
    most = min(_LARGEST_LOSS, 0.5 * width / middle)
    losses = np.geomspace(
        least, max(most, least), max(1, round(np.log(max(most / least, 1.0)) / np.log(_LOSS_STEP)) + 1)
    )
    grid = [(np.arange(low, high, loss * middle) ** 2) * (1 + 1j * loss) for loss in losses]
    beside = [known + offset * known.imag for offset in _OFFSETS]
    return np.concatenate([*grid, *beside])


def best_candidates(
    window: Window,
    fit: WindowFit,
    neighbours: Modes | None,
    trials: ComplexArray,
    least: float = 0.0,
    count: int = 1,
) -> Iterator[Candidate]:
    """Trial poles of the largest gains above `least`, at most one per bandwidth, the best first.

    Far from known poles gains are computed to the last for those trials alone that promise enough where all points
    are weighted alike: products for every point and pair of columns are what takes long.
    """
    scores = _Scores(window, fit, neighbours, trials)
    promise, open_trials = scores.promises(), np.ones(len(trials), dtype=bool)
    gain, parts = np.full(len(trials), np.nan), np.zeros((len(trials), window.values.shape[1]), dtype=complex)
    for _ in range(count):
        while True:
            best = np.nanmax(gain[open_trials], initial=least)
            chosen = np.flatnonzero(open_trials & np.isnan(gain) & (_SURPRISE * promise > best))
            if not len(chosen):
                break
            chosen = chosen[np.argsort(-promise[chosen], kind="stable")[:_CHUNK]]
            gain[chosen], parts[chosen] = scores.gains(chosen)
        rest = np.where(open_trials & (gain > least), gain, -np.inf)
        first = int(np.argmax(rest))
        if np.isneginf(rest[first]):
            return
        yield Candidate(complex(trials[first]), parts[first], float(gain[first]))
        open_trials &= ~_near(trials, trials[first])


def _near(poles: ComplexArray, pole: complex) -> npt.NDArray[np.bool_]:
    """Whether peaks overlap, shape (poles,)."""
    return np.asarray(np.abs(poles - pole) < poles.imag + abs(pole.imag))


@dataclass(frozen=True)
class _Scores:
    """Trial poles beside a fit."""

    window: Window
    fit: WindowFit
    neighbours: Modes | None
    trials: ComplexArray

    @cached_property
    def phi(self) -> ComplexArray:
        """The fit's columns, shape (1 or points, columns, references, lines)."""
        return columns(self.window, self.fit.modes, self.neighbours)

    @cached_property
    def weighted_residual(self) -> ComplexArray:
        """Weight times what the fit leaves, shape (points, references, lines)."""
        explained = fitted(self.fit.linear.unscaled, self.phi.reshape(*self.phi.shape[:2], -1))
        residual = self.window.values - explained.reshape(self.window.values.shape)
        return np.asarray(self.window.weights * residual)

    def promises(self) -> FloatArray:
        """Gains as they are where the weights of all points run alike along the lines, shape (trials,).

        Infinite where it takes each point's weights to tell a new column from the known ones.
        """
        if len(self.phi) > 1:
            return np.full(len(self.trials), np.inf)
        size = self.window.weights.sum(axis=(1, 2), keepdims=True)
        weights = np.mean(self.window.weights / np.maximum(size, np.finfo(float).tiny), axis=0, keepdims=True)
        alike = replace(self.window, values=self.window.values[:1], weights=weights)
        linear = solve_linear(alike, self.phi)
        chunks = np.array_split(np.arange(len(self.trials)), max(1, len(self.trials) // _CHUNK))
        promise = np.concatenate([self._promised(chunk, alike, linear) for chunk in chunks])
        return np.where(self._like_known(), np.inf, promise)

    def _like_known(self) -> npt.NDArray[np.bool_]:
        """Trials beside known poles, and beyond the lines, where a pole looks like a residual term."""
        lines = self.window.squared
        known = [self.fit.modes] if self.neighbours is None else [self.fit.modes, self.neighbours]
        alike = [_near(self.trials, pole) for modes in known for pole in modes.poles]
        return np.any([*alike, self.trials.real < lines[0], self.trials.real > lines[-1]], axis=0)

    def _promised(self, chosen: IntArray, alike: Window, linear: Linear) -> FloatArray:
        curve = self._curve(chosen)
        diagonal, common = _diagonal(self.window.weights, curve), _diagonal(alike.weights, curve)
        schur = _schur(alike.weights, linear, self.phi, curve, common)
        root = np.sqrt(diagonal / np.maximum(common, np.finfo(float).tiny))
        schur = schur * root[..., None] * root[..., None, :]
        return _with_participation(schur, self._score(curve), diagonal, np.inf)[0]

    def gains(self, chosen: IntArray) -> tuple[FloatArray, ComplexArray]:
        """Gain of some trials with their best participations, shape (chosen,), and these."""
        curve = self._curve(chosen)
        diagonal = _diagonal(self.window.weights, curve)
        schur = _schur(self.window.weights, self.fit.linear, self.phi, curve, diagonal)
        return _with_participation(schur, self._score(curve), diagonal, self.fit.linear.chi2)

    def _curve(self, chosen: IntArray) -> ComplexArray:
        return self.window.binned(1.0 / (self.trials[chosen, None] - self.window.squared))

    def _score(self, curve: ComplexArray) -> ComplexArray:
        """Inner products with what is left, shape (trials, points, references)."""
        return np.asarray((self.weighted_residual @ curve.conj().T).transpose(2, 0, 1))


def _diagonal(weights: FloatArray, curve: ComplexArray) -> FloatArray:
    """Σ w |curve|², shape (trials, points, references)."""
    return np.asarray((weights @ (np.abs(curve) ** 2).T).transpose(2, 0, 1))


def _schur(
    weights: FloatArray, linear: Linear, phi: ComplexArray, curve: ComplexArray, diagonal: FloatArray
) -> ComplexArray:
    """What of the new columns lies outside the known ones, shape (trials, points, references, references)."""
    points, references = weights.shape[:2]
    trials, known = len(curve), phi.shape[1]
    cross = np.empty((references, points, known, trials), dtype=complex)
    for j in range(references):
        products = weighted_products(weights[:, j], curve[None], phi[:, :, j])
        cross[j] = products.transpose(0, 2, 1) / linear.norms[:, :, None]
    schur = np.empty((trials, points, references, references), dtype=complex)
    for j in range(references):
        solved = linear.inverse @ cross[j].conj()
        for i in range(references):
            schur[:, :, i, j] = -np.einsum("kat,kat->tk", cross[i], solved)
        schur[:, :, j, j] += diagonal[:, :, j]
    return schur


def _with_participation(
    schur: ComplexArray, score: ComplexArray, diagonal: FloatArray, chi2: FloatArray | float
) -> tuple[FloatArray, ComplexArray]:
    """Gain of every trial with its best participation, and that participation."""
    least = _LEAST_NEW * diagonal.max(axis=2)
    if schur.shape[-1] == 1:
        new = schur[..., 0, 0].real
        return _gain(score[..., 0], new, least, chi2), np.ones((len(schur), 1), dtype=complex)
    mean = schur.mean(axis=1)
    values, vectors = np.linalg.eigh(mean)
    usable = values > least.mean(axis=1)[:, None]
    root = np.where(usable, np.sqrt(np.maximum(values, np.finfo(float).tiny)), np.inf)
    # coordinates in which the mean Schur complement is the identity
    whitened = np.einsum("tij,tki->tkj", vectors.conj(), score) / root[:, None, :]
    _, _, right = np.linalg.svd(whitened, full_matrices=False)
    direction = right[:, 0, :].conj()
    part = np.einsum("tij,tj->ti", vectors, direction.conj() / root)
    part = np.where(np.isfinite(part), part, 0.0)
    norm = np.linalg.norm(part, axis=1, keepdims=True)
    part = np.where(norm > 0, part / np.maximum(norm, np.finfo(float).tiny), np.eye(1, part.shape[1]))
    along = np.einsum("ti,tki->tk", part.conj(), score)
    new = np.einsum("ti,tkij,tj->tk", part.conj(), schur, part).real
    return _gain(along, new, least, chi2), part


def _gain(score: ComplexArray, new: FloatArray, least: FloatArray, chi2: FloatArray | float) -> FloatArray:
    """Fall of χ² of all points together, shape (trials,); none at a point falls by more than there is."""
    gain = np.abs(score) ** 2 / np.maximum(new, least + np.finfo(float).tiny)
    # more than that is rounding: the new column hardly differs from the known ones
    return np.asarray(np.where((new > least) & (gain <= chi2), gain, 0.0).sum(axis=1))
