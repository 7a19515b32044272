"""Derivatives of a hypothesis's residuals: constants by analytic slopes of the frequencies, effects by differences.

A frequency or a split follows the constants by its own mode's ln f alone (`statorhom.diagnose.frequency_slopes`). What
follows them otherwise is moved constant by constant.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import singledispatch

import numpy as np
import numpy.typing as npt

from statorhom.diagnose.any_hypothesis import AnyHypothesis
from statorhom.diagnose.features import Feature
from statorhom.diagnose.frequency_slopes import STEP, by_frequency, concerns, slopes_of
from statorhom.diagnose.hypothesis import Hypothesis, Told
from statorhom.diagnose.prediction import (
    PredictedMode,
    acted_materials,
    material_vector,
    slopes_by_materials,
)
from statorhom.diagnose.stage_model import StageModel
from statorhom.errors import StatorhomError
from statorhom.model.convergence import ModeKey

FloatArray = npt.NDArray[np.float64]
EFFECT_STEP = 1e-2  # of internal coordinates


@singledispatch
def jacobian(h: AnyHypothesis, z: FloatArray) -> FloatArray:
    """Derivative of the residuals, (features, coordinates): by differences where nothing better is known."""
    start = h.features(z)
    columns = [difference(h, z, j, start) for j in range(len(z))]
    return np.array(columns).T.reshape(len(start), len(z))


def difference(h: AnyHypothesis, z: FloatArray, j: int, start: Sequence[Feature]) -> FloatArray:
    """One column of it; `start` are the features that are seen."""
    for sign in (1.0, -1.0):
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
    columns = []
    known = by_frequency(h, z, told, base)
    for j in range(h.constants):
        columns.append(known[j][seen] if j in known else _constant_column(h, z, j, told, seen, start))
    for j in range(h.constants, len(z)):
        columns.append(_effect_column(h, z, j, seen, start))
    return np.array(columns).T.reshape(len(start), len(z))


def _constant_column(
    h: Hypothesis,
    z: FloatArray,
    j: int,
    told: Told,
    seen: Sequence[int],
    start: Sequence[Feature],
) -> FloatArray:
    upper = h.study.constants.limits[1][j]
    for sign in (1.0, -1.0) if z[j] + STEP <= upper else (-1.0,):
        moved = z.copy()
        moved[j] += sign * STEP
        try:
            found, _ = h.all_features(moved, _moved(h, z, moved, told))
        except StatorhomError:
            continue  # at the edge of what materials exist
        return slopes_of(start, [found[i] for i in seen], sign * STEP)
    return np.zeros(len(start))


def _effect_column(
    h: Hypothesis, z: FloatArray, j: int, seen: Sequence[int], start: Sequence[Feature]
) -> FloatArray:
    for sign in (1.0, -1.0):
        moved = z.copy()
        moved[j] += sign * EFFECT_STEP
        try:
            found, _ = h.all_features(moved)
        except StatorhomError:
            continue
        return slopes_of(start, [found[i] for i in seen], sign * EFFECT_STEP)
    return np.zeros(len(start))


def _moved(
    h: Hypothesis, z: FloatArray, moved: FloatArray, told: Told
) -> dict[str, tuple[StageModel, Mapping[str, Mapping[ModeKey, PredictedMode]]]]:
    """Predictions at a neighbouring point to first order: eigenvalues are not solved again."""
    actions = h.actions(z)
    before, after = (h.study.constants.values(p[: h.constants]) for p in (z, moved))
    changed = {name for name in after if after[name] != before[name]}
    found: dict[str, tuple[StageModel, Mapping[str, Mapping[ModeKey, PredictedMode]]]] = {}
    for name, (stage, tests) in told.items():
        new: dict[str, Mapping[ModeKey, PredictedMode]] = {}
        for test, modes in tests.items():
            new[test] = modes
            if not any(concerns(h.study, stage, one) for one in changed):
                continue
            parts = [acted_materials(h.study, stage, v, actions, test) for v in (before, after)]
            regions = tuple(parts[0])
            change = material_vector(parts[1], regions) - material_vector(parts[0], regions)
            slopes = slopes_by_materials(stage, parts[0], modes)
            mesh = after[f"{stage.name}:mesh"] - before[f"{stage.name}:mesh"]
            new[test] = dict(modes) | {
                key: replace(modes[key], log_f=modes[key].log_f + slope @ change + mesh * modes[key].shared)
                for key, slope in slopes.items()
            }
        found[name] = (stage, new)
    return found
