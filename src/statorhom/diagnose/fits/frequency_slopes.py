"""Derivatives by the constants that act through the frequencies: one pass over the features serves all of them.

A feature's residual depends on ln f of its own mode alone, so that moving all modes at once gives every feature's
slope, and the modes' own slopes by the constants do the rest. The scatter of an order touches that order's splits
alone, a loss factor of a material the damping alone.
"""

from __future__ import annotations

from collections.abc import Container, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import cast

import numpy as np
import numpy.typing as npt

from statorhom.diagnose.features.density_features import density_features
from statorhom.diagnose.features.supported import supported_test
from statorhom.diagnose.features.supported_partners import Partners
from statorhom.diagnose.fits.hypothesis import Hypothesis, Told
from statorhom.diagnose.measured.feature import Feature
from statorhom.diagnose.measured.measured_test import MeasuredTest
from statorhom.diagnose.predicted.prediction import (
    PredictedMode,
    acted_materials,
    material_vector,
    slopes_by_materials,
)
from statorhom.diagnose.stages.constants import sinking_of
from statorhom.diagnose.stages.stage_model import StageModel
from statorhom.diagnose.stages.study_model import StudyModel
from statorhom.errors import StatorhomError
from statorhom.model.affine import Materials
from statorhom.model.convergence import ModeKey
from statorhom.physics.action import Action
from statorhom.study.study_file import FREE

FloatArray = npt.NDArray[np.float64]
STEP = 1e-3  # of internal coordinates
LOG_STEP = 1e-6  # of ln f


def by_frequency(h: Hypothesis, z: FloatArray, told: Told, base: Sequence[Feature]) -> dict[int, FloatArray]:
    """Columns (features,) of the derivative by number of the constant, for those that act in the known ways.

    Parameters
    ----------
    h, z : the hypothesis and where.
    told, base : predictions and features there, as `Hypothesis.all_features` gives them.
    """
    constants = h.study.constants
    values, actions = constants.values(z[: h.constants]), h.actions(z)
    columns: dict[int, FloatArray] = {}
    moved = {sinking_of(t.name) for s in h.study.stages for t in s.tests}
    if not h.in_wide_valleys:
        moved |= {name for own in h.study.constants.losses for name in own.values()}
        columns |= _scatter_columns(h, z, told, base)
    columns |= _moved_columns(h, z, told, base, moved)
    acting = [
        j
        for j, name in enumerate(constants.names)
        if any(concerns(h.study, stage, name) for stage in h.study.stages)
    ]
    columns |= {j: np.zeros(len(base)) for j in acting}
    rates = _own_slopes(h, z, told, base)
    places = {test.name: (stage, test) for stage in h.study.stages for test in stage.tests}
    changes = {
        name: _changes(h.study, stage, test, values, z, actions, acting)
        for name, (stage, test) in places.items()
    }
    slopes = {
        name: changes[name].of_modes(stage, told[stage.name][1][name]) for name, (stage, _) in places.items()
    }
    for number, feature in enumerate(base):
        if feature.key is None or feature.test not in places or rates[number] == 0.0:
            continue
        stage, test = places[feature.test]
        if test.support == FREE:
            own = slopes[test.name].get(feature.key)
        else:
            change = changes[test.name].powers(stage)
            own = _supported_slope(h, stage, test, slopes[test.name], change, feature.key[2], actions, z)
        if own is not None:
            for j, slope in zip(acting, own.tolist(), strict=True):
                columns[j][number] = rates[number] * slope
    weighed = [number for number, feature in enumerate(base) if feature.kind == "density"]
    for j in acting:
        columns[j][weighed] = _density_slopes(h, z, j, [base[number] for number in weighed], actions)
    return columns


def slopes_of(start: Sequence[Feature], moved: Sequence[Feature], step: float) -> FloatArray:
    """Of the residuals; none where a mode appears or vanishes on the way, which is a jump."""
    return np.array(
        [
            0.0 if a.lost or b.lost else (b.residual - a.residual) / step
            for a, b in zip(start, moved, strict=True)
        ]
    )


def concerns(study: StudyModel, stage: StageModel, constant: str) -> bool:
    """Whether a constant acts on a stage's frequencies."""
    owners = study.constants.owners[stage.setup.index].values()
    return constant in owners or constant.endswith("mass_kg") or constant == f"{stage.name}:mesh"


def _scatter_columns(
    h: Hypothesis, z: FloatArray, told: Told, base: Sequence[Feature]
) -> dict[int, FloatArray]:
    columns: dict[int, FloatArray] = {}
    for part in ("re", "im"):
        own = {
            j: int(name.split()[1])
            for j, name in enumerate(h.study.constants.names)
            if name.startswith("scatter ") and name.endswith(part)
        }
        if not own:
            continue
        moved = z.copy()
        moved[list(own)] += STEP
        found, _ = h.features_with(moved, told)
        slopes = slopes_of(base, found, STEP)
        orders = np.array([-1 if f.key is None else f.key[0] for f in base])
        columns |= {j: np.where(orders == order, slopes, 0.0) for j, order in own.items()}
    return columns


def _moved_columns(
    h: Hypothesis, z: FloatArray, told: Told, base: Sequence[Feature], names: Container[str]
) -> dict[int, FloatArray]:
    """Of constants that move no free frequency: predictions stay as they are told."""
    columns: dict[int, FloatArray] = {}
    for j, name in enumerate(h.study.constants.names):
        if name in names:
            moved = z.copy()
            moved[j] += STEP
            found, _ = h.features_with(moved, told)
            columns[j] = slopes_of(base, found, STEP)
    return columns


def _own_slopes(h: Hypothesis, z: FloatArray, told: Told, base: Sequence[Feature]) -> FloatArray:
    """Slope of every residual when ln f of all free modes rise alike."""
    raised = {
        name: (
            stage,
            {
                test: {k: replace(m, log_f=m.log_f + LOG_STEP) for k, m in modes.items()}
                for test, modes in tests.items()
            },
        )
        for name, (stage, tests) in told.items()
    }
    found, _ = h.features_with(z, raised)
    return slopes_of(base, found, LOG_STEP)


@dataclass(frozen=True, eq=False)
class _Changes:
    """What the acting constants change for one test.

    Parameters
    ----------
    before : its materials.
    materials : (entries, constants) change of `material_vector`.
    mesh : (constants,) change of the mesh coordinate.
    """

    before: Materials
    materials: FloatArray
    mesh: FloatArray

    def of_modes(
        self, stage: StageModel, modes: Mapping[ModeKey, PredictedMode]
    ) -> dict[ModeKey, FloatArray]:
        """d ln f of a test's free modes."""
        return {
            key: slope @ self.materials + modes[key].shared * self.mesh
            for key, slope in slopes_by_materials(stage, self.before, modes).items()
        }

    def powers(self, stage: StageModel) -> FloatArray:
        """Of `material_change` (entries, constants) from the stage's reference."""
        regions = tuple(self.before)
        start, now = (material_vector(m, regions) for m in (stage.reference, self.before))
        usable = start * now > 0.0
        scale = np.divide(start, now, out=np.ones_like(start), where=usable)
        return scale[:, None] * self.materials


def _changes(
    study: StudyModel,
    stage: StageModel,
    test: MeasuredTest,
    values: Mapping[str, float],
    z: FloatArray,
    actions: Sequence[Action],
    acting: Sequence[int],
) -> _Changes:
    """Of the acting constants."""
    before = acted_materials(study, stage, values, actions, test.name)
    regions = tuple(before)
    start = material_vector(before, regions)
    change = np.zeros((len(start), len(acting)))
    mesh = np.zeros(len(acting))
    for column, j in enumerate(acting):
        constant = study.constants.items[j]
        if constant.name == f"{stage.name}:mesh":
            mesh[column] = (constant.value(z[j] + STEP) - constant.value(z[j] - STEP)) / (2 * STEP)
        elif concerns(study, stage, constant.name):
            change[:, column] = _material_slope(study, stage, test, values, z, j, actions, regions, start)
    return _Changes(before, change, mesh)


def _material_slope(
    study: StudyModel,
    stage: StageModel,
    test: MeasuredTest,
    values: Mapping[str, float],
    z: FloatArray,
    j: int,
    actions: Sequence[Action],
    regions: Sequence[str],
    start: FloatArray,
) -> FloatArray:
    """Of Hooke entries and densities; to the side where there is room and a material."""
    constant, upper = study.constants.items[j], study.constants.limits[1][j]
    for step in (STEP, -STEP) if z[j] + STEP <= upper else (-STEP,):
        moved = {**values, constant.name: constant.value(z[j] + step)}
        try:
            after = acted_materials(study, stage, moved, actions, test.name)
        except StatorhomError:
            continue
        return np.asarray((material_vector(after, regions) - start) / step)
    return np.zeros_like(start)


def _supported_slope(
    h: Hypothesis,
    stage: StageModel,
    test: MeasuredTest,
    slopes: Mapping[ModeKey, FloatArray],
    change: FloatArray,
    number: int,
    actions: Sequence[Action],
    z: FloatArray,
) -> FloatArray | None:
    """d ln f by the constants of a supported mode over that by a rise of all free modes alike."""
    assert h.held is not None
    reference = supported_test(h.study.files, stage, test, actions, h.mark(z))
    partner = cast(Partners, h.held[test.name])[number]
    if reference is None or partner is None:
        return None
    shares = {k: float(share[partner]) for k, share in reference.shares.items() if k in slopes}
    whole = sum(shares.values())
    if whole == 0.0:
        return None
    free = stage.reference_slopes(shares)
    rest = sum(share * (slopes[k] - free[k] @ change) for k, share in shares.items())
    return np.asarray((reference.slopes[partner] @ change + rest) / whole)


def _density_slopes(
    h: Hypothesis, z: FloatArray, j: int, features: Sequence[Feature], actions: Sequence[Action]
) -> FloatArray:
    constant = h.study.constants.items[j]
    if not constant.name.endswith("mass_kg"):
        return np.zeros(len(features))
    values = h.study.constants.values(z[: h.constants])
    values[constant.name] = constant.value(z[j] + STEP)
    return slopes_of(features, density_features(h.study, values, actions), STEP)
