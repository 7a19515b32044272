"""FRF estimators, coherence and random error.

Sources: Bendat & Piersol, Random Data (2010), sections 6.1 and 9.2; Rocklin, Crowley & Vold, A comparison of
H1, H2 and Hv frequency response functions (IMAC 1985).
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from statorhom.recordings.estimation.settings import Estimator
from statorhom.recordings.estimation.spectra import AveragedSpectra, BoolArray, average_spectra

FloatArray = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]

_LEAST_COHERENCE = 1e-6  # keeps the random error finite where a line holds nothing but noise


def frf(spectra: AveragedSpectra, estimator: Estimator) -> ComplexArray:
    """FRF from averaged spectra: NaN where the force (H1, Hv) or the response (H2) is zero.

    H1 = S_xf/S_ff, H2 = S_xx/S_fx, and Hv their geometric mean with the phase that both share, which is total
    least squares with force and response scaled to equal size.

    Returns
    -------
    complex array, shape (channels, lines)
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        if estimator == "H1":
            value = spectra.cross / spectra.force
        elif estimator == "H2":
            value = spectra.response / spectra.cross.conj()
        else:
            value = spectra.cross / np.abs(spectra.cross) * np.sqrt(spectra.response / spectra.force)
    return np.where(np.isfinite(value), value, complex(np.nan, np.nan))


def coherence(spectra: AveragedSpectra) -> FloatArray:
    """Ordinary coherence γ² = |S_xf|²/(S_ff·S_xx), shape (channels, lines); NaN without two averages.

    Of n averages it is biased by (1 − γ²)/n towards one, see `unbiased_coherence`.
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        value = np.abs(spectra.cross) ** 2 / (spectra.force * spectra.response)
    return np.where(spectra.averages[:, np.newaxis] >= 2.0, np.minimum(value, 1.0), np.nan)


def unbiased_coherence(estimated: FloatArray, averages: FloatArray) -> FloatArray:
    """Coherence without the bias of few averages.

    A hit's force is known, not random: the residual over it has n − 1 complex degrees of freedom of n, so
    the estimate's mean is γ² + (1 − γ²)/n, which is solved for γ² here and bounded by zero.

    Parameters
    ----------
    estimated : array, shape (channels, lines)
    averages : array, shape (channels,)
        At least two.
    """
    n = averages[:, np.newaxis]
    return np.maximum((n * estimated - 1.0) / (n - 1.0), 0.0)


def random_error(true_coherence: FloatArray, averages: FloatArray) -> FloatArray:
    """Standard deviation of |H| over |H|: √((1 − γ²)/(2nγ²)) (Bendat & Piersol, equation 9.90)."""
    known = np.maximum(true_coherence, _LEAST_COHERENCE)
    return np.asarray(np.sqrt((1.0 - known) / (2.0 * averages[:, np.newaxis] * known)))


def relative_sd_of_coherence(spectra: AveragedSpectra) -> FloatArray:
    """Standard deviation of the complex H over |H|, shape (channels, lines); NaN without two averages.

    Magnitude and phase err alike, so it is √2 times `random_error`.
    """
    several = spectra.averages >= 2.0
    averages = np.where(several, spectra.averages, 2.0)
    sd = np.sqrt(2.0) * random_error(unbiased_coherence(coherence(spectra), averages), averages)
    return np.where(several[:, np.newaxis], sd, np.nan)


def relative_sd_of_repeats(
    force: ComplexArray, response: ComplexArray, used: BoolArray, estimator: Estimator
) -> FloatArray:
    """Standard deviation of the complex H over |H| from leaving out one hit at a time (jackknife).

    It holds what repeats show, noise as well as hits that missed their point or a structure that is not
    linear.

    Parameters
    ----------
    force : complex array, shape (hits, lines)
    response : complex array, shape (hits, channels, lines)
    used : boolean array, shape (hits, channels)

    Returns
    -------
    array, shape (channels, lines)
        NaN without three hits.
    """
    several = used.sum(axis=0) >= 3
    sd = np.full(response.shape[1:], np.nan)
    if several.any():
        sd[several] = _jackknife(force, response[:, several], used[:, several], estimator)
    return sd


def _jackknife(
    force: ComplexArray, response: ComplexArray, used: BoolArray, estimator: Estimator
) -> FloatArray:
    hits = len(force)
    without = []
    for hit in range(hits):
        others = used & (np.arange(hits) != hit)[:, np.newaxis]
        without.append(frf(average_spectra(force, response, others), estimator))
    left_out = np.array(without)
    n = used.sum(axis=0)[:, np.newaxis]
    mask = used[:, :, np.newaxis]
    mean = np.sum(left_out * mask, axis=0) / n
    variance = (n - 1) / n * np.sum(mask * np.abs(left_out - mean) ** 2, axis=0)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(np.sqrt(variance) / np.abs(frf(average_spectra(force, response, used), estimator)))
