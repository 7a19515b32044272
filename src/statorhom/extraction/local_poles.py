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
_SETTLED = 1e-6  # of χ²: what a further step would gain


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
    fit = _ShiftFit.of(mode.observed, omega, values, sd)
    loss = mode.observed.imag / mode.observed.real
    starts = 0.5 * _STARTS * loss
    chi2 = np.array([fit.profile(np.full(len(values), one))[0] for one in starts])
    shift = starts[np.argmin(chi2, axis=0)]
    best, gradient, information = fit.profile(shift)
    damping = np.full(len(values), 1e-6)
    for _ in range(_ITERATIONS):
        step = gradient / np.maximum(information * (1 + damping), np.finfo(float).tiny)
        if np.all(gradient * step < _SETTLED):
            break
        trial = shift + np.clip(step, -0.5 * loss, 0.5 * loss)
        found = fit.profile(trial)
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


@dataclass(frozen=True)
class _ShiftFit:
    """χ² of every FRF over its shift; all FRFs side by side.

    Attributes
    ----------
    observed : pole of the mode.
    squared : ω², shape (lines,).
    sd : shape (FRFs, lines).
    outside : orthonormal columns, shape (FRFs, lines, 2): what stands for everything else.
    white : measured in units of noise, without what `outside` explains, shape (FRFs, lines).
    """

    observed: complex
    squared: FloatArray
    sd: FloatArray
    outside: ComplexArray
    white: ComplexArray

    @classmethod
    def of(cls, observed: complex, omega: FloatArray, values: ComplexArray, sd: FloatArray) -> _ShiftFit:
        """Of measured receptances (FRFs, lines) without the other modes."""
        line = residual_lines(np.ones(1, dtype=complex), np.zeros(1, dtype=complex), omega / (2 * np.pi))[0]
        columns = np.stack([line, np.ones_like(line)], axis=-1) / sd[..., None]
        outside = np.linalg.qr(columns)[0]
        return cls(observed, omega**2, sd, outside, _without(outside, values / sd))

    def profile(self, shift: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """χ² with the linear unknowns eliminated, half its negative slope and half its curvature."""
        moved = (1 + shift)[:, None]
        curve = 1.0 / (self.observed * moved**2 - self.squared)
        own = _without(self.outside, curve / self.sd)
        size = _products(own, own).real
        residue = (_products(own, self.white) / size)[:, None]
        residual = self.white - residue * own
        # ∂/∂δ of residue/(s(1+δ)² − ω²)
        slope = _without(self.outside, residue * (-2 * self.observed * moved) * curve**2 / self.sd)
        slope = slope - (_products(own, slope) / size)[:, None] * own
        return (
            _products(residual, residual).real,
            _products(slope, residual).real,
            _products(slope, slope).real,
        )


def _without(basis: ComplexArray, values: npt.NDArray[np.complexfloating]) -> ComplexArray:
    """Values (f, l) less their part in orthonormal columns (f, l, k)."""
    parts = basis.conj().transpose(0, 2, 1) @ values[..., None]
    return np.asarray(values - (basis @ parts)[..., 0])


def _products(first: ComplexArray, second: ComplexArray) -> ComplexArray:
    """Row by row aᴴb."""
    return np.asarray((first.conj()[:, None, :] @ second[:, :, None])[:, 0, 0])
