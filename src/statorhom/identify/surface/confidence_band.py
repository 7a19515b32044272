"""Whether verified frequencies lie in the measurement's confidence band: frequency regressed on the mode's number."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.stats import t as student

from statorhom.errors import IdentificationError
from statorhom.identify.parameters.bounds import Array, read_only

LEAST_R2 = 0.98
CONFIDENCE = 0.95


@dataclass(frozen=True, eq=False)
class ConfidenceBand:
    """Regression of measured frequencies on 1, 2, 3, … and the confidence interval of its mean.

    Parameters
    ----------
    coefficients : (degree + 1,) ascending powers of the mode's number (Hz).
    r_squared : coefficient of determination.
    fitted_hz, half_width_hz : (n,) at the modes.
    """

    coefficients: Array
    r_squared: float
    fitted_hz: Array
    half_width_hz: Array

    @property
    def degree(self) -> int:
        """Of the polynomial."""
        return len(self.coefficients) - 1

    @property
    def limits_hz(self) -> Array:
        """(n, 2) lower and upper limit at every mode."""
        return np.column_stack([self.fitted_hz - self.half_width_hz, self.fitted_hz + self.half_width_hz])

    def holds(self, frequencies_hz: Array) -> np.ndarray:
        """(n,) whether each frequency lies in its interval."""
        return np.abs(np.asarray(frequencies_hz) - self.fitted_hz) <= self.half_width_hz


def confidence_band(
    frequencies_hz: Array, least_r2: float = LEAST_R2, confidence: float = CONFIDENCE
) -> ConfidenceBand:
    """Regress with the lowest degree that explains enough.

    The half-width is t s √(x₀ᵀ (XᵀX)⁻¹ x₀) with n − degree − 1 degrees of freedom (Draper and Smith, Applied
    Regression Analysis, section 8.1): the interval of the regression's mean, not of a single frequency.

    Parameters
    ----------
    frequencies_hz : (n,) measured, ascending.
    least_r2 : coefficient of determination to reach.
    confidence : of the interval.

    Raises
    ------
    IdentificationError
        If no degree below n − 1 explains enough: nothing would be left to estimate a scatter from.
    """
    f = np.asarray(frequencies_hz, dtype=float)
    number = np.arange(1, len(f) + 1, dtype=float)
    for degree in range(1, len(f) - 1):
        band = _regressed(number, f, degree, confidence)
        if band.r_squared >= least_r2:
            return band
    raise IdentificationError(
        f"confidence band: {len(f)} frequencies are too few, or rise too unevenly, for a regression with "
        f"R² ≥ {least_r2:g} that leaves a scatter to estimate"
    )


def _regressed(number: Array, f: Array, degree: int, confidence: float) -> ConfidenceBand:
    X = np.vander(number, degree + 1, increasing=True)
    coefficients = np.linalg.lstsq(X, f, rcond=None)[0]
    fitted = X @ coefficients
    free = len(f) - degree - 1
    scatter = float(np.sum((f - fitted) ** 2))
    leverage = np.einsum("ij,jk,ik->i", X, np.linalg.inv(X.T @ X), X)
    half = student.ppf(0.5 + confidence / 2, free) * np.sqrt(scatter / free * leverage)
    total = float(np.sum((f - f.mean()) ** 2))
    r2 = 1.0 - scatter / total if total > 0 else 0.0
    return ConfidenceBand(read_only(coefficients), r2, read_only(fitted), read_only(half))
