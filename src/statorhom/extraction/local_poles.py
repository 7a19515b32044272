"""Where the poles lie in every single FRF: a roving sensor's mass moves them from point to point."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from statorhom.extraction.extraction import ExtractedMode, Extraction, residual_lines
from statorhom.extraction.noise import noise_sd
from statorhom.extraction.point_grid import point_grid
from statorhom.recordings.frf_set import FrfSet

FloatArray = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]

_WINDOW = 3.0  # bandwidths to each side
_LEAST_LINES = 6  # to each side
_STARTS = np.linspace(-3.0, 3.0, 13)  # bandwidths
_ITERATIONS = 12


@dataclass(frozen=True)
class LocalPoles:
    """Shifts of every mode in every FRF.

    Attributes
    ----------
    relative_shift, relative_shift_sd : arrays, shape (modes, FRFs)
        δ of the natural frequency ω_r(1 + δ) seen by one FRF, against the mode's own; the standard deviation
        is infinite where the FRF does not show the mode.
    """

    relative_shift: FloatArray
    relative_shift_sd: FloatArray


def local_poles(extraction: Extraction, frf_set: FrfSet) -> LocalPoles:
    """Fit every mode's frequency in every FRF alone.

    The other modes keep the poles and residues of the extraction; the mode's residue, the two constants that
    stand for everything else, and its shift are free; its loss factor is kept, for a mass moves ω_r only.
    """
    grid = point_grid([frf_set], extraction.band_hz)
    cells = grid.cells
    values = grid.receptance[cells[:, 0], cells[:, 1]]
    sd = noise_sd(grid)[cells[:, 0], cells[:, 1]]
    frequency = grid.omega / (2 * np.pi)
    own = [mode.receptance(frequency)[tuple(extraction.cells.T)] for mode in extraction.modes]
    total = extraction.regenerate(frequency)
    shift = np.zeros((len(own), len(values)))
    deviation = np.full(shift.shape, np.inf)
    for m, mode in enumerate(extraction.modes):
        lines = _lines(mode, frequency)
        rest = values[:, lines] - (total - own[m])[:, lines]
        shift[m], deviation[m] = _shifts(mode, grid.omega[lines], rest, sd[:, lines])
    return LocalPoles(shift, deviation)


def _lines(mode: ExtractedMode, frequency: FloatArray) -> slice:
    reach = _WINDOW * mode.bandwidth_hz
    middle = int(np.searchsorted(frequency, mode.frequency_hz))
    low = min(int(np.searchsorted(frequency, mode.frequency_hz - reach)), middle - _LEAST_LINES)
    high = max(int(np.searchsorted(frequency, mode.frequency_hz + reach)), middle + _LEAST_LINES)
    return slice(max(0, low), min(len(frequency), high))


def _shifts(
    mode: ExtractedMode, omega: FloatArray, values: ComplexArray, sd: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Gauss–Newton on the shift of each FRF, from the best of a row of starts."""
    loss = mode.observed.imag / mode.observed.real
    starts = 0.5 * _STARTS * loss
    chi2 = np.array([_profile(mode, omega, values, sd, np.full(len(values), one))[0] for one in starts])
    shift = starts[np.argmin(chi2, axis=0)]
    best, gradient, information = _profile(mode, omega, values, sd, shift)
    damping = np.full(len(values), 1e-6)
    for _ in range(_ITERATIONS):
        step = gradient / np.maximum(information * (1 + damping), np.finfo(float).tiny)
        trial = shift + np.clip(step, -0.5 * loss, 0.5 * loss)
        found = _profile(mode, omega, values, sd, trial)
        better = found[0] < best
        damping = np.where(better, damping / 4, np.maximum(8 * damping, 1e-3))
        shift = np.where(better, trial, shift)
        best, gradient, information = (
            np.where(better, new, old) for new, old in zip(found, (best, gradient, information), strict=True)
        )
    excess = np.maximum(best / (values.shape[1] - 3.5), 1.0)
    visible = information > 0
    deviation = np.full(len(values), np.inf)
    deviation[visible] = np.sqrt(excess[visible] / (2 * information[visible]))
    return shift, deviation


def _profile(
    mode: ExtractedMode, omega: FloatArray, values: ComplexArray, sd: FloatArray, shift: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """χ² of every FRF with the linear unknowns eliminated, half its negative slope and half its curvature."""
    squared = omega**2
    pole = mode.observed * (1 + shift[:, None]) ** 2
    curve = 1.0 / (pole - squared)
    constants = residual_lines(np.ones(1, dtype=complex), np.zeros(1, dtype=complex), omega / (2 * np.pi))[0]
    columns = (
        np.stack([curve, np.broadcast_to(constants, curve.shape), np.ones_like(curve)], axis=-1)
        / sd[..., None]
    )
    q, r = np.linalg.qr(columns)
    white = values / sd
    projected = np.einsum("flc,fl->fc", q.conj(), white)
    residual = white - np.einsum("flc,fc->fl", q, projected)
    residue = np.linalg.solve(r, projected[..., None])[:, 0, 0]
    # ∂/∂δ of residue/(s(1+δ)² − ω²)
    slope = residue[:, None] * (-2 * mode.observed * (1 + shift[:, None])) * curve**2 / sd
    slope = slope - np.einsum("flc,fc->fl", q, np.einsum("flc,fl->fc", q.conj(), slope))
    gradient = np.sum((slope.conj() * residual).real, axis=1)
    return np.sum(np.abs(residual) ** 2, axis=1), gradient, np.sum(np.abs(slope) ** 2, axis=1)
