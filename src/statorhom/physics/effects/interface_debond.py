"""Winding and teeth have lost contact over an arc."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from statorhom.physics.action import Action, Joint
from statorhom.physics.candidate import Candidate
from statorhom.physics.effect import Confusion, Effect
from statorhom.physics.effects.end_winding_stiffness import WINDING_STEPS
from statorhom.physics.parameter import EffectParameter, angle
from statorhom.study.study import StudyFiles

INTACT = 1e14  # N/m³: stiff enough to be a bond for all modes of the band
ARC = EffectParameter("arc_deg", 20.0, 180.0, 5.0, 330.0, "log", (40.0, 80.0), None)
RATIO = EffectParameter("contact_ratio", 1e-4, 0.5, 1e-5, 1.0, "log", (0.01, 0.002), 1.0)
LOSS = EffectParameter("contact_loss_factor", 0.005, 0.3, 1e-4, 2.0, "log", (0.03,), None)


class InterfaceDebond(Effect):
    name = "interface_debond"
    part = "the winding"
    summary = "winding and teeth have lost contact over an arc"
    citation = "Goodman, Taylor and Brekke (1968), J. Soil Mech. Found. Div. 94, 637 (zero-thickness contact)"
    confused_with = (Confusion("end_winding_stiffness", "the pattern around the circumference"),)
    note = "zero-thickness contact of winding and core, 1e14 N/m³ intact in both directions, scaled within the arc"

    def candidates(self, files: StudyFiles) -> tuple[Candidate, ...]:
        return tuple(
            Candidate(self.name, stage.name, (ARC, RATIO, LOSS, angle()), "winding")
            for stage in files.study.stages
            if stage.kind in WINDING_STEPS and stage.tests
        )

    def action(self, candidate: Candidate, values: Mapping[str, float], files: StudyFiles) -> Action:
        arc = (values["angle_rad"], float(np.deg2rad(values["arc_deg"])))
        joint = Joint(
            ("winding", "overhang"),
            INTACT,
            INTACT,
            arc,
            values["contact_ratio"],
            values["contact_loss_factor"],
        )
        return Action(joint=joint, stages=frozenset({candidate.stage}))


EFFECT = InterfaceDebond()
