"""Derivatives of a hypothesis's residuals: constants by analytic slopes of the frequencies, effects by differences.

Leans depend on constants too where an effect follows the materials; these are differences as well.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import singledispatch

import numpy as np
import numpy.typing as npt

from statorhom.diagnose.fits.any_hypothesis import AnyHypothesis
from statorhom.diagnose.fits.frequency_slopes import by_frequency, slopes_of
from statorhom.diagnose.fits.hypothesis import Hypothesis
from statorhom.diagnose.measured.feature import Feature
from statorhom.errors import StatorhomError
from statorhom.study.regions import core_region

FloatArray = npt.NDArray[np.float64]
# of internal coordinates: much less than a strong effect leaves open of its angle
EFFECT_STEP = 1e-3


@singledispatch
def jacobian(h: AnyHypothesis, z: FloatArray) -> FloatArray:
    """Derivative of the residuals, (features, coordinates): by differences where nothing better is known."""
    start = h.features(z)
    columns = [difference(h, z, j, start) for j in range(len(z))]
    return np.array(columns).T.reshape(len(start), len(z))


def difference(h: AnyHypothesis, z: FloatArray, j: int, start: Sequence[Feature]) -> FloatArray:
    """One column of it; `start` are the features that are seen."""
    low, high = (limits[j] for limits in h.limits())
    if low == high:
        return np.zeros(len(start))  # it stays
    # beyond its limit a place changes nothing
    inwards = 1.0 if z[j] + EFFECT_STEP <= high else -1.0
    for sign in (inwards, -inwards):
        moved = z.copy()
        moved[j] += sign * EFFECT_STEP
        try:
            return slopes_of(start, h.features(moved), sign * EFFECT_STEP)
        except StatorhomError:
            continue  # at the edge of what bodies exist
    return np.zeros(len(start))


@jacobian.register
def _(h: Hypothesis, z: FloatArray) -> FloatArray:
    base, told = h.all_features(z)
    seen = [i for i, f in enumerate(base) if h.sees(f)]
    start = [base[i] for i in seen]
    known = by_frequency(h, z, told, base)
    nothing = np.zeros(len(base))  # a constant of a step that has no test
    columns = [known.get(j, nothing)[seen] for j in range(h.constants)]
    leans = np.array([f.kind == "lean" for f in start])
    for j in _followed(h, z) if leans.any() else ():
        columns[j] = np.where(leans, difference(h, z, j, start), columns[j])
    columns += [difference(h, z, j, start) for j in range(h.constants, len(z))]
    return np.array(columns).T.reshape(len(start), len(z))


def charge_slopes(h: AnyHypothesis, z: FloatArray, charges: FloatArray) -> FloatArray:
    """Derivative of the charges, (features, coordinates): effects alone bring modes together.

    A broken symmetry is solved at the reference whatever the constants are. `charges` are those at z.
    """
    slopes = np.zeros((len(charges), len(z)))
    if not charges.any():
        return slopes
    low, high = h.limits()
    for j in range(h.constants, len(z)):
        if low[j] == high[j]:
            continue  # it stays
        moved = z.copy()
        moved[j] += EFFECT_STEP if z[j] + EFFECT_STEP <= high[j] else -EFFECT_STEP
        try:
            slopes[:, j] = (h.charges(moved) - charges) / (moved[j] - z[j])
        except StatorhomError:
            continue  # at the edge of what bodies exist
    return slopes


def _followed(h: Hypothesis, z: FloatArray) -> list[int]:
    """Constants of the cores whose materials an effect follows."""
    if not any(action.follows_materials for action in h.actions(z)):
        return []
    cores = tuple(f":{core_region(stage.reference)}." for stage in h.study.stages)
    return [j for j, name in enumerate(h.study.constants.names) if any(core in name for core in cores)]
