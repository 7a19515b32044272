"""Only part of the winding's mass moves with the teeth."""

from __future__ import annotations

from collections.abc import Mapping

from statorhom.model.affine import Material, Materials
from statorhom.physics.action import Action
from statorhom.physics.candidate import Candidate
from statorhom.physics.effect import Confusion, Effect
from statorhom.physics.effects.end_winding_stiffness import WINDING_STEPS
from statorhom.physics.parameter import EffectParameter
from statorhom.study.study import StudyFiles

FRACTION = EffectParameter("participating_fraction", 0.3, 0.97, 0.02, 1.0, "log", (0.7, 0.4), 1.0)


class LooseWindingMass(Effect):
    name = "loose_winding_mass"
    part = "the winding"
    summary = "only part of the winding's mass moves with the teeth"
    citation = "Soedel (2004), Vibrations of Shells and Plates (added masses)"
    confused_with = (Confusion("wrong_input", "weighing again"),)
    note = "the rest of the winding's mass is absent from the dynamics"

    def candidates(self, files: StudyFiles) -> tuple[Candidate, ...]:
        return tuple(
            Candidate(self.name, stage.name, (FRACTION,), "winding")
            for stage in files.study.stages
            if stage.kind in WINDING_STEPS and stage.tests
        )

    def action(self, candidate: Candidate, values: Mapping[str, float], files: StudyFiles) -> Action:
        def rule(materials: Materials) -> Materials:
            share = values["participating_fraction"]
            light = {
                region: Material(materials[region].hooke, share * materials[region].density)
                for region in ("winding", "overhang")
                if region in materials
            }
            return {**materials, **light}

        return Action(materials=rule, stages=frozenset({candidate.stage}))


EFFECT = LooseWindingMass()
