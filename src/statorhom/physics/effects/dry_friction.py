"""A contact slips: stiffness falls and damping rises with the amplitude."""

from __future__ import annotations

from collections.abc import Mapping

from statorhom.physics.action import Action, Friction
from statorhom.physics.candidate import Candidate
from statorhom.physics.effect import Confusion, Effect
from statorhom.physics.parameter import EffectParameter
from statorhom.study.study import StudyFiles
from statorhom.study.study_file import FREE

SHARE = EffectParameter("stiffness_share", 0.003, 0.15, 1e-4, 0.7, "log", (0.03,), None)
DROP = EffectParameter("stiffness_drop", 0.001, 0.08, 1e-5, 0.5, "log", (0.01,), None)
EXPONENT = EffectParameter("amplitude_exponent", -0.9, -0.1, -0.999, -0.001, "linear", (-0.5,), None)
LAW = "law"


class DryFriction(Effect):
    name = "dry_friction"
    part = "a contact"
    summary = "a contact slips: stiffness falls and damping rises with the amplitude"
    citation = "Gaul and Nitsche (2001), Appl. Mech. Rev. 54 (joints); Iwan (1966), J. Appl. Mech. 33"
    confused_with = (
        Confusion("viscoelastic_winding", "tests at three force levels"),
        Confusion("temperature_shift", "tests at three force levels, the lowest one repeated at the end"),
    )
    note = (
        "harmonic balance of every mode by itself at its resonance, the force at an antinode; a Jenkins element that "
        "carries stiffness_share of the modal stiffness while it sticks and slips at slip_force_n times the root mean "
        "square of the mode's radial motion, or micro-slip with dissipation as the amplitude to amplitude_exponent + 3"
    )

    def candidates(self, files: StudyFiles) -> tuple[Candidate, ...]:
        found = []
        for stage in files.study.stages:
            levels = {
                t.force_level_n for t in stage.tests if t.support == FREE and t.force_level_n is not None
            }
            if len(levels) < 2:
                continue
            hardest = max(levels)
            slip = EffectParameter(
                "slip_force_n",
                0.01 * hardest,
                hardest,
                1e-5 * hardest,
                1e3 * hardest,
                "log",
                (0.05 * hardest, 0.3 * hardest),
                None,
            )
            found.append(Candidate(self.name, stage.name, (slip, SHARE), choice=((LAW, "jenkins"),)))
            found.append(Candidate(self.name, stage.name, (EXPONENT, DROP), choice=((LAW, "iwan"),)))
        return tuple(found)

    def action(self, candidate: Candidate, values: Mapping[str, float], files: StudyFiles) -> Action:
        stages = frozenset({candidate.stage})
        if candidate.chosen[LAW] == "jenkins":
            law = Friction("jenkins", values["stiffness_share"], slip_force=values["slip_force_n"])
        else:
            law = Friction("iwan", values["stiffness_drop"], exponent=values["amplitude_exponent"])
        return Action(friction=law, stages=stages)


EFFECT = DryFriction()
