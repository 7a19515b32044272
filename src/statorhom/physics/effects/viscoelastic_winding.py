"""The winding's modulus rises with frequency."""

from __future__ import annotations

import math
from collections.abc import Mapping

from statorhom.physics.action import Action
from statorhom.physics.candidate import Candidate
from statorhom.physics.effect import Confusion, Effect
from statorhom.physics.effects.end_winding_stiffness import WINDING_STEPS
from statorhom.physics.parameter import EffectParameter
from statorhom.study.study import StudyFiles

REFERENCE_HZ = 1000.0
LEAST = 0.02  # a linear law in log f would pass zero far below the band
SLOPE = EffectParameter("modulus_slope_per_decade", -0.1, 0.8, -0.5, 2.5, "linear", (0.3,), 0.0)


class ViscoelasticWinding(Effect):
    name = "viscoelastic_winding"
    part = "the winding"
    summary = "the winding's modulus rises with frequency"
    citation = "Nashif, Jones and Henderson (1985), Vibration Damping (moduli over frequency)"
    confused_with = (Confusion("end_winding_stiffness", "a probe on the overhang"),)
    note = "E(f) = E(1 kHz) (1 + a log10(f / 1 kHz)) of slots and overhang alike"

    def candidates(self, files: StudyFiles) -> tuple[Candidate, ...]:
        return tuple(
            Candidate(self.name, stage.name, (SLOPE,), "winding")
            for stage in files.study.stages
            if stage.kind in WINDING_STEPS and stage.tests
        )

    def action(self, candidate: Candidate, values: Mapping[str, float], files: StudyFiles) -> Action:
        def factor(frequency_hz: float) -> float:
            slope = values["modulus_slope_per_decade"]
            return max(LEAST, 1.0 + slope * math.log10(frequency_hz / REFERENCE_HZ))

        law = {"winding": factor, "overhang": factor}
        return Action(modulus_at=law, stages=frozenset({candidate.stage}))


EFFECT = ViscoelasticWinding()
