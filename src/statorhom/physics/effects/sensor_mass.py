"""The roving accelerometer's mass moves the poles from point to point."""

from __future__ import annotations

from collections.abc import Mapping

from statorhom.physics.action import Action
from statorhom.physics.candidate import Candidate
from statorhom.physics.effect import Confusion, Effect
from statorhom.physics.parameter import EffectParameter
from statorhom.study.study import StudyFiles

# a miniature accelerometer weighs half a gram, one with a magnetic foot 50 g
MASS = EffectParameter("mass_kg", 0.001, 0.03, 1e-4, 0.2, "log", (0.008,), None)


class SensorMass(Effect):
    name = "sensor_mass"
    part = "the sensors"
    on_tubes = True
    summary = "the roving accelerometer's mass moves the poles from point to point"
    citation = "Ewins (2000), Modal Testing, ch. 3"
    confused_with = (Confusion("attached_mass", "the poles of all points agree"),)
    note = "at the accelerometer's place on the surface, in all directions"

    def candidates(self, files: StudyFiles) -> tuple[Candidate, ...]:
        return tuple(
            Candidate(self.name, stage.name, (MASS,), None, test.name)
            for stage in files.study.stages
            for test in stage.tests
            if test.modal_table is None and not test.weighed
        )

    def coupon_candidates(self, files: StudyFiles) -> tuple[Candidate, ...]:
        return self.candidates(files)

    def action(self, candidate: Candidate, values: Mapping[str, float], files: StudyFiles) -> Action:
        stages, tests = frozenset({candidate.stage}), frozenset({str(candidate.test)})
        return Action(sensor_kg=values["mass_kg"], stages=stages, tests=tests)


EFFECT = SensorMass()
