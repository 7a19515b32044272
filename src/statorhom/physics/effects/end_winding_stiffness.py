"""The winding's overhang is not the material in the slots."""

from __future__ import annotations

from collections.abc import Mapping

from statorhom.materials.hooke import Hooke
from statorhom.model.affine import Material, Materials
from statorhom.physics.action import Action
from statorhom.physics.candidate import Candidate
from statorhom.physics.effect import Confusion, Effect
from statorhom.physics.parameter import EffectParameter
from statorhom.study.study import StudyFiles

RATIO = EffectParameter("stiffness_ratio", 0.15, 6.0, 0.01, 100.0, "log", (0.5, 2.0, 0.2, 5.0), 1.0)
WINDING_STEPS = ("wound", "impregnated")


class EndWindingStiffness(Effect):
    name = "end_winding_stiffness"
    part = "the winding"
    summary = "the overhang of the winding is stiffer or softer than the winding in the slots"
    citation = "Den Hartog (1956), Mechanical Vibrations, ch. 3 (the vibration absorber)"
    confused_with = (
        Confusion("viscoelastic_winding", "a probe on the overhang"),
        Confusion("loose_winding_mass", "a probe on the overhang"),
    )
    note = "all moduli of the overhang over those of the slots, its density unchanged"

    def candidates(self, files: StudyFiles) -> tuple[Candidate, ...]:
        return tuple(
            Candidate(self.name, stage.name, (RATIO,), "overhang")
            for i, stage in enumerate(files.study.stages)
            if stage.kind in WINDING_STEPS and stage.tests and files.study.symmetry(i, "overhang") is None
        )

    def action(self, candidate: Candidate, values: Mapping[str, float], files: StudyFiles) -> Action:
        def rule(materials: Materials) -> Materials:
            slot = materials["overhang"]
            own = Material(Hooke(values["stiffness_ratio"] * slot.hooke.matrix), slot.density)
            return {**materials, "overhang": own}

        return Action(materials=rule, stages=frozenset({candidate.stage}))


EFFECT = EndWindingStiffness()
