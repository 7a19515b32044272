"""Pole shifts from set-up to set-up: whether they are there, and whether a sensor's mass explains them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.interpolate import PchipInterpolator
from scipy.stats import chi2

from statorhom.errors import IdentificationError

FloatArray = npt.NDArray[np.float64]

_WITHIN_90 = float(chi2.ppf(0.9, 1))
_LEAST_SHIFT = 1e-5  # of the largest mass
_KNOTS, _SEARCHED, _REFINED = 50, 800, 121
_CLOSE = 0.05  # of the frequency: modes that a sensor can turn into each other
_BARE_ITERATIONS = 8


@dataclass(frozen=True)
class SensorMass:
    """Mass that explains pole shifts, one for all modes or for a single one.

    Attributes
    ----------
    mass_kg : float
        Most probable mass (kg), 0 or more.
    ci90_kg : (float, float)
        90 % interval, from the profile of the likelihood: where several masses explain the shifts, all of
        them lie in it.
    p_shift : float
        Probability of such shifts if the poles were the same in all set-ups.
    p_mass : float
        Probability that a mass explains so much of them by chance.
    p_rest : float
        Probability of what the mass leaves, from the noise alone: small where the shifts follow something
        else besides.
    """

    mass_kg: float
    ci90_kg: tuple[float, float]
    p_shift: float
    p_mass: float
    p_rest: float


@dataclass(frozen=True)
class PoleShiftTrend:
    """Pole shifts over the grid.

    Attributes
    ----------
    joint : SensorMass
        From all modes together.
    modes : tuple of SensorMass
        From each mode's poles alone; the others still take part as neighbours.
    mirror_kg : ndarray, shape (modes,)
        The other mass that explains a close doublet's poles as well: a mass and a split of the bare doublet
        change places without a trace, so if all doublets
        have the same mirror, it is as likely as the joint mass. NaN for modes without a close neighbour.
    bare_hz : ndarray, shape (modes,)
        Frequencies without the joint mass (Hz).
    predicted : ndarray, shape (set-ups, modes)
        Relative shifts from their mean that the joint mass explains.
    observed : ndarray, shape (set-ups, modes)
        Measured relative shifts from their mean; NaN where missing.
    """

    joint: SensorMass
    modes: tuple[SensorMass, ...]
    mirror_kg: FloatArray
    bare_hz: FloatArray
    predicted: FloatArray
    observed: FloatArray

    def __post_init__(self) -> None:
        for array in (self.mirror_kg, self.bare_hz, self.predicted, self.observed):
            array.setflags(write=False)


def pole_shift_trend(
    frequency_hz: npt.ArrayLike, frequency_sd_hz: npt.ArrayLike, amplitude: npt.ArrayLike
) -> PoleShiftTrend:
    """Explain the natural frequencies of single set-ups by a mass m that sits at each set-up's place.

    With modal coordinates of unit mass the set-up's modes are those of Λ q = λ (I + m Σ_d φ_d φ_dᵀ) q: for a
    mode far from others δf/f = −½ m φ². A close doublet is turned by the mass, and only the lower mode of
    it moves; the eigenproblem of all modes holds both.

    Parameters
    ----------
    frequency_hz : array_like, shape (set-ups, modes)
        Natural frequencies, ascending modes (Hz); NaN where a set-up does not show one.
    frequency_sd_hz : array_like, same shape
        Their standard deviations (Hz).
    amplitude : array_like, shape (set-ups, modes) or (set-ups, modes, directions)
        Mass-normalised amplitudes (1/√kg), real, at each set-up's place. A sensor's mass moves in all
        directions: where tangential or axial motion is left out, the mass comes out wrong by their share
        (too small by about 1/r² for radial motion alone of a thin ring). Of a doublet that the sensor splits
        more than it is split itself, every set-up shows one moving pole: enter it as one mode, with the
        motions of both its shapes as directions.

    Raises
    ------
    IdentificationError
        When the arrays do not fit, or fewer than three set-ups show any mode.
    """
    f, sd = np.asarray(frequency_hz, dtype=float), np.asarray(frequency_sd_hz, dtype=float)
    phi = np.asarray(amplitude, dtype=float)
    phi = phi[..., None] if phi.ndim == 2 else phi
    if f.ndim != 2 or f.shape != sd.shape or phi.shape[:2] != f.shape:
        raise IdentificationError(
            f"pole shifts need frequencies, deviations and amplitudes of one shape, got {f.shape}, {sd.shape} "
            f"and {phi.shape[:2]}"
        )
    present = np.isfinite(f) & (sd > 0) & np.isfinite(phi).all(axis=2)
    if (present.sum(axis=0) < 3).any():
        raise IdentificationError("pole shifts need every mode in three set-ups at least")
    values = np.where(present, f, np.nan)
    weight = np.where(present, values**2 / sd**2, 0.0)
    mean = np.nansum(weight * np.nan_to_num(values), axis=0) / weight.sum(axis=0)
    observed = np.nan_to_num(values / mean - 1)
    phi = np.nan_to_num(phi)
    table, bare = _mass_table(mean, phi, weight)
    # close doublets make several masses fit: the whole range is searched
    masses = np.array([0.0, *np.geomspace(_LEAST_SHIFT, 1.0, _SEARCHED) * table.x[-1]])
    every = range(f.shape[1])
    rough = _explain(observed, weight, masses, table(masses), every).mass_kg
    masses = np.unique([*masses, *np.linspace(0.97, 1.03, _REFINED) * min(rough, table.x[-1] / 1.03)])
    shifts = table(masses)
    joint = _explain(observed, weight, masses, shifts, every)
    single = tuple(_explain(observed, weight, masses, shifts, [mode]) for mode in every)
    alone = np.asarray(bare(joint.mass_kg))
    predicted, mirror = table(joint.mass_kg), _mirror(alone, phi)
    return PoleShiftTrend(joint, single, mirror, alone, predicted, np.where(present, observed, np.nan))


def _mass_table(
    f_hz: FloatArray, phi: FloatArray, weight: FloatArray
) -> tuple[PchipInterpolator, PchipInterpolator]:
    """Relative shifts, and frequencies without mass, over masses up to a fifth of the most mobile mode's.

    The frequencies of the bare structure are not known: for every mass they are those that give the loaded
    ones their measured means.
    """
    square = np.sum(phi**2, axis=2)
    largest = 0.4 / max(float(square.max()), np.finfo(float).tiny)
    knots = np.array([0.0, *np.geomspace(_LEAST_SHIFT, 1.0, _KNOTS) * largest])
    bare, table, alone = f_hz.copy(), [], []
    for mass in knots:
        for _ in range(_BARE_ITERATIONS):
            shifts = _loaded(mass, bare, phi) / f_hz - 1
            bare = _ascending(bare * (1 - np.sum(weight * shifts, axis=0) / weight.sum(axis=0)))
        table.append(_loaded(mass, bare, phi) / f_hz - 1)
        alone.append(bare)
    return PchipInterpolator(knots, table), PchipInterpolator(knots, alone)


def _mirror(bare_hz: FloatArray, phi: FloatArray) -> FloatArray:
    """Masses that would split each mode and its neighbour as far as they lie apart (kg)."""
    square = np.sum(phi**2, axis=2)
    pair = np.maximum((square[:, 1:] + square[:, :-1]).mean(axis=0), np.finfo(float).tiny)
    masses = 2 * np.diff(bare_hz) / bare_hz[1:] / pair
    close = np.where(np.diff(bare_hz) <= _CLOSE * bare_hz[1:], masses, np.nan)
    mirror: FloatArray = np.fmin(np.append(close, np.nan), np.insert(close, 0, np.nan))
    return mirror


def _ascending(f_hz: FloatArray) -> FloatArray:
    """Nearby frequencies that ascend: a mass too large for a doublet's split asks for a negative one."""
    high, low = np.maximum.accumulate(f_hz), np.minimum.accumulate(f_hz[::-1])[::-1]
    middle: FloatArray = (high + low) / 2
    return middle


def _explain(
    observed: FloatArray, weight: FloatArray, masses: FloatArray, shifts: FloatArray, modes: Sequence[int]
) -> SensorMass:
    chosen = list(modes)
    rest = observed[:, chosen] - shifts[:, :, chosen]
    misfit = np.einsum("asm,sm->a", rest**2, weight[:, chosen])
    freedom = int(np.count_nonzero(weight[:, chosen])) - len(chosen)
    best = int(np.argmin(misfit))
    none, left = float(misfit[0]), float(misfit[best])
    # misfit that the noise does not explain makes the mass less certain
    wider = max(1.0, left / max(freedom - 1, 1))
    likely = np.flatnonzero(misfit <= left + wider * _WITHIN_90)
    low, high = masses[max(likely[0] - 1, 0)], masses[min(likely[-1] + 1, masses.size - 1)]
    return SensorMass(
        float(masses[best]),
        (float(low), float(high)),
        float(chi2.sf(none, freedom)),
        # no mass is at the end of its range: half of all chance comes out there
        0.5 * float(chi2.sf(none - left, 1)) if best else 1.0,
        float(chi2.sf(left, max(freedom - 1, 1))),
    )


def _loaded(mass_kg: float, bare_hz: FloatArray, phi: FloatArray) -> FloatArray:
    """Frequencies (Hz) with a mass at every set-up, shape (set-ups, modes), as the modes are ordered."""
    added = np.eye(bare_hz.size) + mass_kg * np.einsum("smd,snd->smn", phi, phi)
    # Λ q = λ M q as the symmetric problem of Λ^{−½} M Λ^{−½} and 1/λ
    inverse = np.linalg.eigvalsh(added / np.outer(bare_hz, bare_hz))[:, ::-1]
    loaded: FloatArray = 1 / np.sqrt(inverse)
    return loaded
