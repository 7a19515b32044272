"""Frame and core are joined by a contact of finite stiffness."""

from __future__ import annotations

from collections.abc import Mapping

from statorhom.physics.action import Action, Joint
from statorhom.physics.candidate import Candidate
from statorhom.physics.effect import Confusion, Effect
from statorhom.physics.parameter import EffectParameter
from statorhom.study.study import StudyFiles

CONTACT = EffectParameter("contact_stiffness_n_per_m3", 1e11, 1e14, 1e10, 1e16, "log", (3e12, 3e11), None)
SHARE = EffectParameter("tangential_ratio", 0.3, 1.0, 0.05, 2.0, "log", (0.6,), None)


class PressFitContact(Effect):
    name = "press_fit_contact"
    part = "the fit of the frame"
    summary = "frame and core are joined by a contact of finite stiffness"
    citation = "Johnson (1985), Contact Mechanics, ch. 13 (rough surfaces)"
    confused_with = (Confusion("wrong_input", "the frame alone"),)
    note = "zero-thickness contact of frame and core, the same everywhere; the stiffness is the normal one"

    def candidates(self, files: StudyFiles) -> tuple[Candidate, ...]:
        return tuple(
            Candidate(self.name, stage.name, (CONTACT, SHARE), "frame")
            for stage in files.study.stages
            if stage.kind == "framed" and stage.tests
        )

    def action(self, candidate: Candidate, values: Mapping[str, float], files: StudyFiles) -> Action:
        stiffness = values["contact_stiffness_n_per_m3"]
        names = [stage.name for stage in files.study.stages]
        later = frozenset(names[names.index(candidate.stage) :])
        return Action(
            joint=Joint(("frame",), stiffness, values["tangential_ratio"] * stiffness), stages=later
        )


EFFECT = PressFitContact()
