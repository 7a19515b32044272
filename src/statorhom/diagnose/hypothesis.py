"""One explanation of all tests of a study: the declared model, with none, one or two effects added."""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import cast

import numpy as np
import numpy.typing as npt

from statorhom.diagnose.dimension_response import changed_geometry, step_of
from statorhom.diagnose.features import (
    Feature,
    Keys,
    assigned,
    free_features,
    loading,
    missed_cost,
    shift_features,
)
from statorhom.diagnose.masses import (
    LAMINATION_DENSITY,
    LAMINATION_DENSITY_SD,
    stage_densities,
)
from statorhom.diagnose.measured import MeasuredTest
from statorhom.diagnose.prediction import PredictedMode, acted_materials, material_vector, predicted
from statorhom.diagnose.stage_model import StageModel
from statorhom.diagnose.study_model import StudyModel
from statorhom.diagnose.supported import (
    Partners,
    SupportedReference,
    attached,
    partners,
    predicted_logs,
    supported_features,
    supported_reference,
)
from statorhom.errors import StatorhomError
from statorhom.model.convergence import ModeKey
from statorhom.physics.action import Action
from statorhom.physics.candidate import Candidate
from statorhom.physics.library import library
from statorhom.study.modal_table import MeasuredMode
from statorhom.study.study_file import FREE

FloatArray = npt.NDArray[np.float64]
STEP = 1e-3  # of internal coordinates
EFFECT_STEP = 1e-2

Predictions = Mapping[str, Mapping[ModeKey, PredictedMode]]


@dataclass(frozen=True, eq=False)
class Hypothesis:
    """Residuals of all features over the constants x and the effects' parameters p, in internal coordinates.

    Parameters
    ----------
    study : the model.
    candidates : effects added.
    left_out : groups of features (`Feature.group`) that the residuals do not see.
    held : test → partners of its modes; None to pair anew.
    missed : -2 ln of the chance that the tests did not find the predicted modes that have no partner.
    discrepancy : relative standard deviation added to all frequencies: makes the valleys wide enough to be found.
    """

    study: StudyModel
    candidates: tuple[Candidate, ...] = ()
    left_out: frozenset[tuple[str, ModeKey | None]] = frozenset()
    held: Mapping[str, Keys | Partners] | None = None
    missed: float = 0.0
    discrepancy: float = 0.0

    @property
    def constants(self) -> int:
        """Number of constants, the first part of the vector."""
        return len(self.study.constants)

    @cached_property
    def parameters(self) -> tuple[tuple[int, int], ...]:
        """Candidate and parameter number of the vector's second part."""
        return tuple((i, j) for i, c in enumerate(self.candidates) for j in range(len(c.parameters)))

    def __len__(self) -> int:
        return self.constants + len(self.parameters)

    def effect_values(self, z: FloatArray) -> tuple[dict[str, float], ...]:
        """Parameters of every candidate by name."""
        found: list[dict[str, float]] = [{} for _ in self.candidates]
        for (i, j), u in zip(self.parameters, z[self.constants :].tolist(), strict=True):
            parameter = self.candidates[i].parameters[j]
            found[i][parameter.name] = parameter.value(u)
        return tuple(found)

    def actions(self, z: FloatArray) -> tuple[Action, ...]:
        """What the effects do."""
        values = self.effect_values(z)
        return tuple(
            library()[c.effect].action(c, v, self.study.files)
            for c, v in zip(self.candidates, values, strict=True)
        )

    def mark(self, z: FloatArray) -> tuple[tuple[str, tuple[float, ...]], ...]:
        """What the actions depend on."""
        values = self.effect_values(z)
        return tuple((c.label, tuple(v.values())) for c, v in zip(self.candidates, values, strict=True))

    def limits(self) -> tuple[FloatArray, FloatArray]:
        """Of the coordinates; angles have none."""
        low, high = self.study.constants.limits
        pairs = []
        for i, j in self.parameters:
            p = self.candidates[i].parameters[j]
            free = p.scale == "angle"
            pairs.append((-np.inf, np.inf) if free else (p.internal(p.lower), p.internal(p.upper)))
        both = np.array(pairs).reshape(-1, 2)
        return np.r_[low, both[:, 0]], np.r_[high, both[:, 1]]

    @cached_property
    def prior_weights(self) -> FloatArray:
        """1 where the prior is standard normal, 0 where it is uniform."""
        located = [self.candidates[i].parameters[j].located for i, j in self.parameters]
        return np.r_[np.ones(self.constants), 1.0 - np.array(located, dtype=float)]

    def paired(self, z: FloatArray) -> Hypothesis:
        """With the pairing held as it is at z.

        Raises
        ------
        StatorhomError
            If no stator has these constants.
        """
        values, actions = self.study.constants.values(z[: self.constants]), self.actions(z)
        held: dict[str, Keys | Partners] = {}
        missed = 0.0
        for stage in self.study.stages:
            for test in stage.tests:
                if test.support != FREE:
                    held[test.name] = self._supported_partners(stage, test, values, actions, self.mark(z))
                else:
                    found = predicted(self.study, stage, values, actions, test.name, self.mark(z))
                    keys = assigned(test, self.modes(test, actions), found)
                    held[test.name] = keys
                    missed += missed_cost(test, keys, found)
        return replace(self, held=held, missed=missed)

    @staticmethod
    def modes(test: MeasuredTest, actions: Sequence[Action]) -> tuple[MeasuredMode, ...]:
        """Measured modes, their names corrected."""
        names: dict[tuple[str, str], tuple[int, int]] = {}
        for action in actions:
            names |= dict(action.names)
        return test.named(names)

    def features(self, z: FloatArray, left_out: bool = False) -> list[Feature]:
        """All features that are seen, or those that are left out."""
        found, _ = self._features(z)
        return [f for f in found if self._sees(f) != left_out]

    def _sees(self, feature: Feature) -> bool:
        """Wide valleys are sought with frequencies alone."""
        if self.discrepancy and feature.kind not in ("frequency", "density"):
            return False
        return feature.group not in self.left_out

    def residuals(self, z: FloatArray) -> FloatArray:
        """Of the features that are seen, without the prior."""
        return np.array([f.residual for f in self.features(z)])

    def _features(
        self, z: FloatArray, moved: Mapping[str, tuple[StageModel, Predictions]] | None = None
    ) -> tuple[list[Feature], dict[str, tuple[StageModel, Predictions]]]:
        values, actions = self.study.constants.values(z[: self.constants]), self.actions(z)
        assert self.held is not None
        found = self._densities(values, actions)
        told: dict[str, tuple[StageModel, Predictions]] = {}
        for stage in self.study.stages:
            free: dict[str, Mapping[ModeKey, PredictedMode]] = {}
            for test in stage.tests:
                known = moved[stage.name][1].get(test.name) if moved else None
                if test.support != FREE:
                    modes = known if known is not None else self._unsupported(stage, test, values, actions)
                    found += self._supported(stage, test, modes, actions, self.mark(z))
                else:
                    modes = (
                        known
                        if known is not None
                        else self._partners(stage, test, values, actions, self.mark(z))
                    )
                    found += self._free(stage, test, modes, values, actions)
                free[test.name] = modes
            told[stage.name] = (stage, free)
        return found, told

    def _unsupported(
        self, stage: StageModel, test: MeasuredTest, values: Mapping[str, float], actions: Sequence[Action]
    ) -> dict[ModeKey, PredictedMode]:
        """Free modes that a supported test is made of; what is attached is solved together with the support."""
        return predicted(self.study, stage, values, [replace(a, changes=None) for a in actions], test.name)

    def _supported_partners(
        self,
        stage: StageModel,
        test: MeasuredTest,
        values: Mapping[str, float],
        actions: Sequence[Action],
        mark: tuple[Hashable, ...],
    ) -> Partners:
        reference = self._reference(stage, test, actions, mark)
        if reference is None:
            return ()
        logs = predicted_logs(stage, reference, self._unsupported(stage, test, values, actions))
        return partners(test, reference, logs)

    def _reference(
        self, stage: StageModel, test: MeasuredTest, actions: Sequence[Action], mark: tuple[Hashable, ...]
    ) -> SupportedReference | None:
        declared = self.study.files.study.support(test.support)
        held = [a.supports[test.support] for a in actions if test.support in a.supports]
        keys = held[-1] if held else declared
        assert keys is not None
        here = [(a, m) for a, m in zip(actions, mark, strict=True) if a.touches(stage.name, test.name)]
        parts = [(attached(stage, a), m, test.support in a.supports) for a, m in here]
        seen = tuple(m for part, m, held_otherwise in parts if part or held_otherwise)
        return supported_reference(stage, test, keys, [c for part, _, _ in parts for c in part], seen)

    def _supported(
        self,
        stage: StageModel,
        test: MeasuredTest,
        modes: Mapping[ModeKey, PredictedMode],
        actions: Sequence[Action],
        mark: tuple[Hashable, ...],
    ) -> list[Feature]:
        assert self.held is not None
        reference = self._reference(stage, test, actions, mark)
        if reference is None:
            return []
        found = supported_features(
            test, cast(Partners, self.held[test.name]), predicted_logs(stage, reference, modes)
        )
        return [replace(f, sd=float(np.hypot(f.sd, self.discrepancy))) if f.key else f for f in found]

    def _partners(
        self,
        stage: StageModel,
        test: MeasuredTest,
        values: Mapping[str, float],
        actions: Sequence[Action],
        mark: Hashable,
    ) -> dict[ModeKey, PredictedMode]:
        """Predicted modes that have a measured partner."""
        assert self.held is not None
        held = self.held[test.name]
        found = predicted(self.study, stage, values, actions, test.name, mark)
        return {key: mode for key, mode in found.items() if key in held}

    def _free(
        self,
        stage: StageModel,
        test: MeasuredTest,
        modes: Mapping[ModeKey, PredictedMode],
        values: Mapping[str, float],
        actions: Sequence[Action],
    ) -> list[Feature]:
        assert self.held is not None
        keys, measured = cast(Keys, self.held[test.name]), self.modes(test, actions)
        scatter = {
            int(name.split()[1]): complex(value, values[f"{name[:-2]}im"])
            for name, value in values.items()
            if name.startswith("scatter") and name.endswith("re")
        }
        sensor = sum(a.sensor_kg for a in actions if a.touches(stage.name, test.name))
        if sensor:
            modes = {
                k: replace(m, log_f=m.log_f - loading(test, k, stage.amplitudes, sensor))
                for k, m in modes.items()
            }
        found = free_features(test, measured, keys, modes, scatter, stage.error, self.discrepancy)
        if test.shifts:
            labels = {m.label: k for m, k in zip(measured, keys, strict=True) if k is not None}
            found += shift_features(test, labels, stage.amplitudes, sensor)
        return found

    def _densities(self, values: Mapping[str, float], actions: Sequence[Action]) -> list[Feature]:
        """What is known of the lamination's density."""
        corrected: dict[str, float] = {}
        dimensions: dict[str, float] = {}
        for action in actions:
            corrected |= dict(action.masses)
            dimensions |= dict(action.dimensions)
        stage = self.study.stages[0]
        volumes = self.study.volumes(stage.setup)
        if dimensions:
            volumes = step_of(self.study, stage, changed_geometry(self.study, dimensions)).exact_volumes()
        masses = self.study.masses(values, corrected)
        density = stage_densities(self.study.files, masses, stage.setup.index, volumes)
        if "lamination" not in density:
            return []
        rho = density["lamination"]
        return [Feature("density", "", None, rho, LAMINATION_DENSITY, LAMINATION_DENSITY_SD)]

    def jacobian(self, z: FloatArray) -> FloatArray:
        """Derivative of the residuals, (features, coordinates)."""
        base, told = self._features(z)
        seen = [i for i, f in enumerate(base) if self._sees(f)]
        start = np.array([base[i].residual for i in seen])
        columns = []
        for j in range(self.constants):
            columns.append(self._constant_column(z, j, told, seen, start))
        for j in range(self.constants, len(z)):
            columns.append(self._effect_column(z, j, start))
        return np.array(columns).T.reshape(len(start), len(z))

    def _constant_column(
        self,
        z: FloatArray,
        j: int,
        told: Mapping[str, tuple[StageModel, Predictions]],
        seen: Sequence[int],
        start: FloatArray,
    ) -> FloatArray:
        upper = self.study.constants.limits[1][j]
        for sign in (1.0, -1.0) if z[j] + STEP <= upper else (-1.0,):
            moved = z.copy()
            moved[j] += sign * STEP
            try:
                found, _ = self._features(moved, self._moved(z, moved, told))
            except StatorhomError:
                continue  # at the edge of what materials exist
            return (np.array([found[i].residual for i in seen]) - start) / (sign * STEP)
        return np.zeros(len(start))

    def _effect_column(self, z: FloatArray, j: int, start: FloatArray) -> FloatArray:
        for sign in (1.0, -1.0):
            moved = z.copy()
            moved[j] += sign * EFFECT_STEP
            try:
                return (self.residuals(moved) - start) / (sign * EFFECT_STEP)
            except StatorhomError:
                continue
        return np.zeros(len(start))

    def _moved(
        self, z: FloatArray, moved: FloatArray, told: Mapping[str, tuple[StageModel, Predictions]]
    ) -> dict[str, tuple[StageModel, Predictions]]:
        """Predictions at a neighbouring point to first order: eigenvalues are not solved again."""
        actions = self.actions(z)
        before, after = (self.study.constants.values(p[: self.constants]) for p in (z, moved))
        changed = {name for name in after if after[name] != before[name]}
        found: dict[str, tuple[StageModel, Predictions]] = {}
        for name, (stage, tests) in told.items():
            new: dict[str, Mapping[ModeKey, PredictedMode]] = {}
            for test, modes in tests.items():
                new[test] = modes
                if not any(_concerns(self.study, stage, one) for one in changed):
                    continue
                parts = [acted_materials(self.study, stage, v, actions, test) for v in (before, after)]
                regions = tuple(parts[0])
                change = material_vector(parts[1], regions) - material_vector(parts[0], regions)
                slopes = stage.slopes(parts[0], modes)
                mesh = after[f"{stage.name}:mesh"] - before[f"{stage.name}:mesh"]
                new[test] = {
                    key: replace(
                        modes[key], log_f=modes[key].log_f + slope @ change + mesh * modes[key].shared
                    )
                    for key, slope in slopes.items()
                }
            found[name] = (stage, new)
        return found


def _concerns(study: StudyModel, stage: StageModel, constant: str) -> bool:
    owners = study.constants.owners[stage.setup.index].values()
    return constant in owners or constant.endswith("mass_kg") or constant == f"{stage.name}:mesh"
