"""A support that is declared rigid is elastic."""

from __future__ import annotations

from collections.abc import Mapping

from statorhom.physics.action import Action
from statorhom.physics.candidate import Candidate
from statorhom.physics.effect import Confusion, Effect
from statorhom.physics.parameter import EffectParameter
from statorhom.study.study import StudyFiles
from statorhom.study.supports import FaceSupport, LineSupport, SupportKeys

# a line that is stiffer than the metal it presses on is rigid
NORMAL = EffectParameter("normal_stiffness_n_per_m2", 3e8, 1e11, 1e7, 2e11, "log", (1e10, 1e9, 1e11), None)
AREA = EffectParameter("normal_stiffness_n_per_m3", 1e10, 1e13, 1e9, 1e15, "log", (3e11, 1e13), None)
LOSS = EffectParameter("loss_factor", 0.005, 0.2, 1e-4, 2.0, "log", (0.03,), None)
RATIO = EffectParameter("tangential_ratio", 0.2, 1.5, 0.02, 4.0, "log", (0.7,), None)


class SupportCompliance(Effect):
    name = "support_compliance"
    part = "a support"
    summary = "a support that is declared rigid is elastic"
    citation = "Ewins (2000), Modal Testing, ch. 3"
    confused_with = (Confusion("temperature_shift", "the free test: only the supported one is off"),)
    note = "springs along the lines, per metre of length, stiffness times 1 + i loss_factor"

    def candidates(self, files: StudyFiles) -> tuple[Candidate, ...]:
        found = []
        for support in files.study.supports:
            tests = [
                (s.name, t.name) for s in files.study.stages for t in s.tests if t.support == support.name
            ]
            if support.declared == "rigid" and tests:
                stage, test = tests[0]
                normal = NORMAL if isinstance(support, LineSupport) else AREA
                choice = (("support", support.name),)
                found.append(Candidate(self.name, stage, (normal, RATIO, LOSS), None, test, choice))
        return tuple(found)

    def action(self, candidate: Candidate, values: Mapping[str, float], files: StudyFiles) -> Action:
        name = str(candidate.chosen["support"])
        keys = next(s for s in files.study.supports if s.name == name)
        return Action(supports={name: elastic(keys, values)}, support_losses={name: values["loss_factor"]})

    def reported(self, candidate: Candidate, values: Mapping[str, float]) -> dict[str, float | str]:
        return {p.name: values[p.name] for p in candidate.parameters}


def elastic(keys: SupportKeys, values: Mapping[str, float]) -> SupportKeys:
    """A support's table as it would stand in the study if its stiffness were known."""
    table = {**keys.model_dump(), "declared": "elastic"}
    table |= {k: v for k, v in values.items() if k == "tangential_ratio" or k.startswith("normal_stiffness")}
    return (
        type(keys).model_validate(table)
        if isinstance(keys, FaceSupport)
        else LineSupport.model_validate(table)
    )


EFFECT = SupportCompliance()
