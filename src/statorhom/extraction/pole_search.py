"""Where one more pole would explain most of what a fit left over.

For a pole at a trial place the gain in χ² from free residues at all points and references follows from
linear least squares alone, so a whole grid of trial frequencies and loss factors is scored at once.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from statorhom.extraction.modal_model import Modes, Window, columns, weighted_products
from statorhom.extraction.window_fit import WindowFit

FloatArray = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]

_OFFSETS = (-1.0, -0.4, -0.1, 0.0, 0.1, 0.4, 1.0)  # of trial poles beside known ones, in bandwidths
_LEAST_NEW = 1e-7  # part of a column that must lie outside the known columns
_LARGEST_LOSS = 0.5
_LINES_PER_BANDWIDTH = 1.5  # a narrower pole cannot be told from one bad line
_LOSS_STEP = 3.0  # trial loss factors; a trial pole half a bandwidth off still finds its mode
_CHUNK = 48


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
    window: Window, fit: WindowFit, neighbours: Modes | None, trials: ComplexArray, count: int = 1
) -> list[Candidate]:
    """Trial poles of the largest gain, at most one per bandwidth."""
    phi = columns(window, fit.modes, neighbours)
    unscaled = fit.linear.coefficients / fit.linear.norms
    residual = window.values - (unscaled[:, None] @ phi.reshape(*phi.shape[:2], -1)).reshape(
        window.values.shape
    )
    weighted_residual = window.weights * residual
    gains, scores = [], []
    for begin in range(0, len(trials), _CHUNK):
        curve = window.binned(1.0 / (trials[begin : begin + _CHUNK, None] - window.squared))
        gain, part = _gains(window, fit, phi, weighted_residual, curve)
        gains.append(gain)
        scores.append(part)
    gain, parts = np.concatenate(gains), np.concatenate(scores)
    chosen: list[Candidate] = []
    for i in np.argsort(-gain):
        near = any(abs(trials[i] - c.pole) < abs(c.pole.imag) + trials[i].imag for c in chosen)
        if not near:
            chosen.append(Candidate(complex(trials[i]), parts[i], float(gain[i])))
        if len(chosen) == count:
            break
    return chosen


def _gains(
    window: Window, fit: WindowFit, phi: ComplexArray, weighted_residual: ComplexArray, curve: ComplexArray
) -> tuple[FloatArray, ComplexArray]:
    """Gain of every trial with its best participation, and that participation."""
    points, references = window.values.shape[:2]
    trials, known = len(curve), phi.shape[1]
    conjugate = curve.conj().T
    score = np.empty((trials, points, references), dtype=complex)
    cross = np.empty((references, points, known, trials), dtype=complex)
    diagonal = np.empty((references, points, trials))
    for j in range(references):
        weights = window.weights[:, j]
        score[:, :, j] = (weighted_residual[:, j] @ conjugate).T
        products = weighted_products(weights, curve[None], phi[:, :, j])
        cross[j] = products.transpose(0, 2, 1) / fit.linear.norms[:, :, None]
        diagonal[j] = weights @ (np.abs(curve) ** 2).T
    # Schur complement: what of the new columns lies outside the known ones
    schur = np.empty((trials, points, references, references), dtype=complex)
    for j in range(references):
        solved = fit.linear.inverse @ cross[j].conj()
        for i in range(references):
            schur[:, :, i, j] = -np.einsum("kat,kat->tk", cross[i], solved)
        schur[:, :, j, j] += diagonal[j].T
    least = _LEAST_NEW * diagonal.max(axis=0).T
    if references == 1:
        new = schur[..., 0, 0].real
        gain = np.where(
            new > least, np.abs(score[..., 0]) ** 2 / np.maximum(new, least + np.finfo(float).tiny), 0.0
        )
        return gain.sum(axis=1), np.ones((trials, 1), dtype=complex)
    return _with_participation(schur, score, least)


def _with_participation(
    schur: ComplexArray, score: ComplexArray, least: FloatArray
) -> tuple[FloatArray, ComplexArray]:
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
    gain = np.where(new > least, np.abs(along) ** 2 / np.maximum(new, least + np.finfo(float).tiny), 0.0)
    return gain.sum(axis=1), part
