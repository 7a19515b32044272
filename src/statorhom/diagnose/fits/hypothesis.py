"""One explanation of all tests of a stator or tube: the declared model, with none, one or two effects added."""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import cast

import numpy as np
import numpy.typing as npt

from statorhom.diagnose.features.assignment import NEAR, Keys, Sought, sought
from statorhom.diagnose.features.damping import (
    free_losses,
    is_damped,
    losses_of,
    supported_losses,
    with_shares,
)
from statorhom.diagnose.features.density_features import density_features
from statorhom.diagnose.features.detection import detection_cost
from statorhom.diagnose.features.lean import lean_features
from statorhom.diagnose.features.levels import (
    common_keys,
    force_levels,
    level_bases,
    level_features,
    slipped,
)
from statorhom.diagnose.features.mode_features import free_features, loading, shift_features, with_rows
from statorhom.diagnose.features.supported import predicted_logs, supported_test, without_attachments
from statorhom.diagnose.features.supported_partners import Partners, partners, supported_features
from statorhom.diagnose.fits.any_hypothesis import AnyHypothesis
from statorhom.diagnose.measured.feature import Feature
from statorhom.diagnose.measured.measured_test import MeasuredTest
from statorhom.diagnose.predicted.counted_planes import counted_at_planes
from statorhom.diagnose.predicted.followed_modes import Names, names_of, with_partners
from statorhom.diagnose.predicted.prediction import PredictedMode, acted_materials, predicted
from statorhom.diagnose.predicted.sensor_response import shifted_response
from statorhom.diagnose.processes.memory import Memory
from statorhom.diagnose.stages.constants import scatter_of, sinking_of
from statorhom.diagnose.stages.stage_model import StageModel
from statorhom.diagnose.stages.study_model import StudyModel
from statorhom.model.affine import Materials
from statorhom.model.convergence import ModeKey
from statorhom.physics.action import Action
from statorhom.physics.candidate import Candidate
from statorhom.study.modal_table import MeasuredMode
from statorhom.study.study_file import FREE

FloatArray = npt.NDArray[np.float64]
Predictions = Mapping[str, Mapping[ModeKey, PredictedMode]]
Told = Mapping[str, tuple[StageModel, Predictions]]


@dataclass(frozen=True, eq=False)
class Hypothesis(AnyHypothesis):
    """Of a stator or tube: an effect shifts and splits the modes of a cyclic body.

    Parameters
    ----------
    study : the model.
    held : test → partners of its modes; None to pair anew.
    names : test → names of the predicted modes by their places, held with the partners.
    """

    study: StudyModel
    held: Mapping[str, Keys | Partners] | None = None
    names: Mapping[str, Names] = field(default_factory=dict)
    # the last point's features: whoever pairs, polishes and judges asks for the same ones in turn
    _last: dict[bytes, tuple[list[Feature], Told]] = field(default_factory=dict, init=False, repr=False)

    @property
    def memories(self) -> Sequence[Memory]:
        """Of all steps."""
        return [stage.memory for stage in self.study.stages]

    def mark(self, z: FloatArray) -> tuple[tuple[str, tuple[float, ...]], ...]:
        """What the actions depend on."""
        values = self.effect_values(z)
        kind = "" if self.trained else " untrained"
        own = ((c.label + kind, tuple(v.values())) for c, v in zip(self.candidates, values, strict=True))
        return (*own, *((f"declared {i}", ()) for i in range(len(self.study.effects))))

    def of_others(self, candidates: tuple[Candidate, ...]) -> Hypothesis:
        """The same with other effects, to be paired anew; of the machine as it is typed, unless they correct it."""
        other = super().of_others(candidates)
        typed = self.study.as_typed
        if typed is None:
            return other
        corrected = {name for a in other.actions(np.zeros(len(other))) for name in a.dimensions}
        return other if corrected >= self.study.dimensions.keys() else replace(other, study=typed)

    def materials(self, stage: StageModel, z: FloatArray) -> Materials:
        """Of a step, as constants and effects make them.

        Raises
        ------
        MassError, MaterialError
            If no material has these constants.
        """
        values = self.study.constants.values(z[: self.constants])
        return acted_materials(self.study, stage, values, self.actions(z))

    def with_tests(self, tests: Mapping[str, MeasuredTest]) -> Hypothesis:
        """Of other measurements of the same tests, to be paired anew.

        Parameters
        ----------
        tests : by name.
        """
        stages = [s.with_tests([tests.get(t.name, t) for t in s.tests]) for s in self.study.stages]
        return self.with_stages(tuple(stages))

    def with_stages(self, stages: tuple[StageModel, ...]) -> Hypothesis:
        """Of other models of the steps, or of some steps alone, to be paired anew."""
        return replace(self, study=self.study.with_stages(stages), held=None)

    def paired(self, z: FloatArray) -> Hypothesis:
        """With the pairing held as it is at z: of near partners, or of far ones where these leave less.

        Raises
        ------
        StatorhomError
            If no stator has these constants.
        """
        values, actions = self.study.constants.values(z[: self.constants]), self.actions(z)
        held: dict[str, Keys | Partners] = {}
        names: dict[str, Names] = {}
        free: list[tuple[Sought, Mapping[ModeKey, PredictedMode]]] = []
        seen: dict[str, Mapping[ModeKey, PredictedMode]] = {}
        for stage in self.study.stages:
            for test in stage.tests:
                seen[test.name] = found = self._predicted(stage, test, values, actions, self.mark(z))
                names[test.name] = names_of({key: one.mode for key, one in found.items()})
                if test.support != FREE:
                    held[test.name] = self._partners(stage, test, found, z)
                else:
                    there = acted_materials(self.study, stage, values, actions, test.name)
                    shown = counted_at_planes(stage, test, found, there)
                    free.append((sought(test, self.modes(test, actions), shown), shown))
        rest = replace(self, held=held, names=names)
        far, near = (rest._with_free(free, reach) for reach in (1.0, NEAR))
        far._last[z.tobytes()] = far.features_with(z, far._told(z, values, actions, seen))
        if far.held == near.held:
            return far
        near._last[z.tobytes()] = near.features_with(z, near._told(z, values, actions, seen))
        return min(far, near, key=lambda h: float(np.sum(h.residuals(z) ** 2)) + h.charge(z))

    def _with_free(
        self, free: Sequence[tuple[Sought, Mapping[ModeKey, PredictedMode]]], reach: float
    ) -> Hypothesis:
        """With partners of free tests too, no farther away than `reach` says."""
        keys = {among.test.name: among.within(reach) for among, _ in free}
        missed = sum(detection_cost(among.test, keys[among.test.name], found) for among, found in free)
        return replace(self, held={**(self.held or {}), **keys}, missed=missed)

    def _partners(
        self, stage: StageModel, test: MeasuredTest, found: Mapping[ModeKey, PredictedMode], z: FloatArray
    ) -> Partners:
        """Of a supported test's modes; none where its support cannot be modelled."""
        values, actions = self.study.constants.values(z[: self.constants]), self.actions(z)
        reference = supported_test(self.study.files, stage, test, actions, self.mark(z), shapes=True)
        if reference is None:
            return ()
        there = acted_materials(self.study, stage, values, actions, test.name)
        return partners(stage, test, reference, found, there)

    @staticmethod
    def modes(test: MeasuredTest, actions: Sequence[Action]) -> tuple[MeasuredMode, ...]:
        """Measured modes, their names corrected."""
        names: dict[tuple[str, str], tuple[int, int]] = {}
        for action in actions:
            names |= dict(action.names)
        return test.named(names)

    def features_of_all(self, z: FloatArray) -> list[Feature]:
        """Features whether seen or left out, at a held pairing; in wide valleys frequencies and splits alone."""
        return self.all_features(z)[0]

    def all_features(self, z: FloatArray) -> tuple[list[Feature], Told]:
        """The same, and the predictions behind them."""
        point = z.tobytes()
        if point not in self._last:
            found = self.features_with(z)
            self._last.clear()
            self._last[point] = found
        return self._last[point]

    def features_with(self, z: FloatArray, moved: Told | None = None) -> tuple[list[Feature], Told]:
        """The same with predictions that were moved, where there are any."""
        values, actions = self.study.constants.values(z[: self.constants]), self.actions(z)
        found = density_features(self.study, values, actions)
        told = self._told(z, values, actions) if moved is None else moved
        for stage in self.study.stages:
            known = told[stage.name][1]
            for test in stage.tests:
                if test.support != FREE:
                    found += self._supported(stage, test, known[test.name], values, actions, self.mark(z))
                else:
                    found += self._free(stage, test, known, values, actions)
        return found, told

    def _told(
        self,
        z: FloatArray,
        values: Mapping[str, float],
        actions: Sequence[Action],
        seen: Predictions | None = None,
    ) -> Told:
        """What features need of modes, of those that pairing has seen at the same point or anew."""
        told: dict[str, tuple[StageModel, Predictions]] = {}
        for stage in self.study.stages:
            known: dict[str, Mapping[ModeKey, PredictedMode]] = {}
            for test in stage.tests:
                if seen is None:
                    names = self._followed[test.name]
                    modes = self._predicted(stage, test, values, actions, self.mark(z), names)
                else:
                    modes = seen[test.name]
                known[test.name] = self._needed(stage, test, modes, values, actions)
            told[stage.name] = (stage, known)
        return told

    @cached_property
    def _followed(self) -> Mapping[str, Names]:
        """Test → names of the modes that are predicted; where a step is free, of problems with partners alone."""
        assert self.held is not None
        found: dict[str, Names] = {}
        for stage in self.study.stages:
            own = {test.name: self.names[test.name] for test in stage.tests}
            free = all(test.support == FREE for test in stage.tests)
            found |= with_partners(own, {name: cast(Keys, self.held[name]) for name in own}) if free else own
        return found

    def _needed(
        self,
        stage: StageModel,
        test: MeasuredTest,
        modes: Mapping[ModeKey, PredictedMode],
        values: Mapping[str, float],
        actions: Sequence[Action],
    ) -> Mapping[ModeKey, PredictedMode]:
        """Predicted modes that the features of a test need, with their damping."""
        assert self.held is not None
        if test.support == FREE:
            # only what has a measured partner matters
            held = set(cast(Keys, self.held[test.name]))
            modes = {k: m for k, m in modes.items() if k in held}
        if self._is_damped(test, actions):
            modes = with_shares(self.study, stage, test, modes, values, actions)
        levels = force_levels(stage)
        for action in actions:
            if action.friction is not None and test.name in levels and action.touches(stage.name, test.name):
                quiet = self._losses(stage, test, modes, values, actions)
                modes = slipped(modes, action.friction, levels[test.name], max(levels.values()), quiet)
        return modes

    def _is_damped(self, test: MeasuredTest, actions: Sequence[Action]) -> bool:
        """Whether damping matters: what slips is moved by it even where frequencies alone are seen."""
        slips = any(action.friction is not None for action in actions)
        return is_damped(self.study, test) and (slips or not self.in_wide_valleys)

    def _losses(
        self,
        stage: StageModel,
        test: MeasuredTest,
        modes: Mapping[ModeKey, PredictedMode],
        values: Mapping[str, float],
        actions: Sequence[Action],
    ) -> dict[ModeKey, float]:
        """Loss factors of predicted modes; none where no damping is predicted."""
        return losses_of(self.study, stage, modes, values, actions) if self._is_damped(test, actions) else {}

    def _predicted(
        self,
        stage: StageModel,
        test: MeasuredTest,
        values: Mapping[str, float],
        actions: Sequence[Action],
        mark: Sequence[Hashable],
        names: Names | None = None,
    ) -> Mapping[ModeKey, PredictedMode]:
        """Named free modes; of a supported test those that it is made of, without what is attached."""
        if test.support != FREE:
            actions = [without_attachments(a) for a in actions]
        return predicted(self.study, stage, values, actions, test.name, mark, names)

    def _supported(
        self,
        stage: StageModel,
        test: MeasuredTest,
        modes: Mapping[ModeKey, PredictedMode],
        values: Mapping[str, float],
        actions: Sequence[Action],
        mark: tuple[Hashable, ...],
    ) -> list[Feature]:
        assert self.held is not None
        reference = supported_test(self.study.files, stage, test, actions, mark)
        if reference is None:
            return []
        there = acted_materials(self.study, stage, values, actions, test.name)
        logs, held = predicted_logs(stage, reference, modes, there), cast(Partners, self.held[test.name])
        logs = logs - values.get(sinking_of(test.name), 0.0) * reference.sinking
        found = supported_features(test, held, logs, reference.own, self.discrepancy)
        losses = self._losses(stage, test, modes, values, actions)
        if losses:
            springs = sum(a.support_losses.get(test.support, 0.0) for a in actions)
            found += supported_losses(test, held, reference, losses, springs)
        return found

    def _free(
        self,
        stage: StageModel,
        test: MeasuredTest,
        known: Mapping[str, Mapping[ModeKey, PredictedMode]],
        values: Mapping[str, float],
        actions: Sequence[Action],
    ) -> list[Feature]:
        assert self.held is not None
        modes = known[test.name]
        losses = self._losses(stage, test, modes, values, actions)
        keys, measured = cast(Keys, self.held[test.name]), self.modes(test, actions)
        sensor = sum(a.sensor_kg for a in actions if a.touches(stage.name, test.name))
        response = shifted_response(stage, test)
        if sensor and response is not None:
            modes = {
                k: replace(m, log_f=m.log_f - loading(test, k, response, sensor)) for k, m in modes.items()
            }
        found = free_features(test, measured, keys, modes, scatter_of(values), stage.error, self.discrepancy)
        base = level_bases(stage).get(test.name)
        if base is not None:
            lower = next(t for t in stage.tests if t.name == base)
            both = (cast(Keys, self.held[base]), keys)
            twice = set(common_keys(both))
            # the lowest level's frequencies, splits and losses stand for those of all levels
            found = [f for f in found if f.key not in twice]
            quiet = self._losses(stage, lower, known[base], values, actions)
            found += level_features(
                test, (self.modes(lower, actions), measured), both, (known[base], modes), (quiet, losses)
            )
        elif self._is_damped(test, actions):
            found += free_losses(test, measured, keys, losses)
        if response is not None and not self.in_wide_valleys:
            labels = {m.label: k for m, k in zip(measured, keys, strict=True) if k is not None}
            found += shift_features(test, labels, response, sensor)
        if stage.heights_m and test.shapes is not None and not self.in_wide_valleys:
            found += lean_features(test, measured, keys, modes, stage.heights_m)
        return with_rows(found, measured, keys)
