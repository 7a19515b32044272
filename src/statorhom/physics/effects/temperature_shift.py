"""A test was run at another temperature than the others."""

from __future__ import annotations

from collections.abc import Mapping

from statorhom.materials.hooke import Hooke
from statorhom.model.affine import Material, Materials
from statorhom.physics.action import Action
from statorhom.physics.candidate import Candidate
from statorhom.physics.effect import Confusion, Effect
from statorhom.physics.parameter import EffectParameter
from statorhom.study.study import StudyFiles

# relative change of stiffness per kelvin: steel; resin between wires
SLOPES = {"lamination": -3e-4, "frame": -3e-4, "machine": -3e-4, "winding": -1e-2, "overhang": -1e-2}
LEAST = 0.05  # of the stiffness stays
TEMPERATURE = EffectParameter("temperature_k", -40.0, 60.0, -80.0, 150.0, "linear", (20.0,), 0.0)


class TemperatureShift(Effect):
    name = "temperature_shift"
    part = "the conditions of a test"
    summary = "a test was run at another temperature than assumed"
    citation = "Nashif, Jones and Henderson (1985), Vibration Damping (moduli over temperature)"
    confused_with = (Confusion("wrong_input", "a thermometer"),)
    note = "difference from the temperature assumed; stiffness of steel -3e-4 per K, of windings -1e-2 per K"

    def candidates(self, files: StudyFiles) -> tuple[Candidate, ...]:
        tests = [(stage.name, test.name) for stage in files.study.stages for test in stage.tests]
        # the first test is what the others are compared with: the constants are those at its temperature
        return tuple(Candidate(self.name, stage, (TEMPERATURE,), None, test) for stage, test in tests[1:])

    def action(self, candidate: Candidate, values: Mapping[str, float], files: StudyFiles) -> Action:
        def rule(materials: Materials) -> Materials:
            return {
                region: Material(
                    Hooke(max(LEAST, 1.0 + SLOPES[region] * values["temperature_k"]) * material.hooke.matrix),
                    material.density,
                )
                for region, material in materials.items()
            }

        stages, tests = frozenset({candidate.stage}), frozenset({str(candidate.test)})
        return Action(materials=rule, stages=stages, tests=tests)


EFFECT = TemperatureShift()
