"""A first guess of the sensor's load, from the poles of the planes and the waves of their residues."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from statorhom.extraction.roving.load import RovingLoad, load_of
from statorhom.extraction.roving.plane_poles import PlanePoles
from statorhom.extraction.roving.rings import Rings
from statorhom.extraction.roving.wave import Wave, wave
from statorhom.recordings.dof import Dof

FloatArray = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]

_TELLING = 0.3  # of the largest weight: modes whose planes tell the mass
_OWN = (0.3, 2.0)  # of the common mass: limits of what one mode's planes tell alone
_LEAST_LOAD = 1e-7
_FAINT = 0.02  # of a doublet's load: what a mode inside the reach of its poles has that is but its image


def first_load(found: PlanePoles, unit: float, rings: Rings, references: Sequence[Dof]) -> RovingLoad | None:
    """Load that puts the poles where they are in every plane; None where no mass does that.

    What the planes have in common tells nothing of the load: it follows from the mass.

    Parameters
    ----------
    unit : of the search's poles ((rad/s)²).
    """
    count = found.poles.shape[1]
    waves = [wave(found.residues[..., m] * unit, rings, references) for m in range(count)]
    mobility = np.array([one.mobility for one in waves])
    fallen = -np.log(found.poles.real.T)
    fallen = fallen - fallen.mean(axis=1, keepdims=True)
    masses = _masses(waves, fallen)
    # planes that move alike tell no mass, whatever else lets their poles differ
    varied = np.minimum(1.0, np.ptp(mobility, axis=1) / mobility.mean(axis=1))
    weights = np.ptp(fallen, axis=1) * varied
    common = _weighted_median(masses, weights)
    if common is None:
        return None
    tells = np.isfinite(masses) & (weights > _TELLING * weights.max())
    own = np.where(tells, np.clip(masses, _OWN[0] * common, _OWN[1] * common), common)
    mean = np.maximum(own * mobility.mean(axis=1), -fallen.min(axis=1))
    load = np.expm1(mean[:, None] + fallen)
    loss = (found.poles.imag / found.poles.real).mean(axis=0)
    bare = np.mean(found.poles.real.T * (1 + load), axis=1) * (1 + 1j * loss) * unit
    poles = found.poles * unit
    kept = ~_are_images(poles.real, bare, _exact(poles, bare))
    exact = _exact(poles[:, kept], bare[kept])
    return RovingLoad(
        bare[kept],
        np.array([one.order for one in waves])[kept],
        exact,
        np.full(exact.shape, np.inf),
        np.zeros((len(exact), 2)),
        found.misfit.mean(axis=0)[kept],
        rings,
    )


def _exact(poles: ComplexArray, bare: ComplexArray) -> FloatArray:
    """Loads that move the bare poles to those of every plane, shape (modes, planes)."""
    return np.maximum(np.array([load_of(row, bare) for row in poles]).T.real, _LEAST_LOAD)


def _are_images(places: FloatArray, bare: ComplexArray, load: FloatArray) -> npt.NDArray[np.bool_]:
    """Modes that stay where a doublet moves: its half that does not move radially, which scatter lets the sensor see.

    Parameters
    ----------
    places : array, shape (planes, modes)
        ω² of the poles in every plane.
    load : array, shape (modes, planes)
    """
    low, high = places.min(axis=0), places.max(axis=0)
    inside = (low[:, None] > low - bare.imag) & (high[:, None] < bare.real + bare.imag)
    faint = load.max(axis=1)[:, None] < _FAINT * load.max(axis=1)
    return np.asarray(np.any(inside & faint, axis=1))


def _masses(waves: Sequence[Wave], fallen: FloatArray) -> FloatArray:
    """Mass that each mode's planes tell (kg); NaN where they tell none."""
    found = []
    for one, fall in zip(waves, fallen, strict=True):
        away = one.mobility - one.mobility.mean()
        size = float(away @ away)
        found.append(float(away @ fall) / size if one.order > 0 and size > 0 else np.nan)
    return np.array(found)


def _weighted_median(masses: FloatArray, weights: FloatArray) -> float | None:
    """Of the modes that weigh most; None where they tell no mass."""
    telling = np.isfinite(masses) & (weights > _TELLING * weights.max(initial=0.0))
    if not telling.any():
        return None
    order = np.argsort(masses[telling])
    share = np.cumsum(weights[telling][order])
    middle = float(masses[telling][order][np.searchsorted(share, 0.5 * share[-1])])
    return middle if middle > 0 else None
