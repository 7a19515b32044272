"""A test that is declared free hangs on something stiff."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from statorhom.mesh.hex_mesh import HalfPitchMesh
from statorhom.model.affine import Materials
from statorhom.model.broken.attachments import point_springs
from statorhom.model.broken.change import Change
from statorhom.physics.action import Action, Attachment
from statorhom.physics.candidate import Candidate
from statorhom.physics.effect import Confusion, Effect, Words
from statorhom.physics.parameter import EffectParameter, angle
from statorhom.physics.plan import places_on, plan_of
from statorhom.physics.ring import ring_of
from statorhom.study.study import StudyFiles
from statorhom.study.study_file import FREE

STIFFNESS = EffectParameter("stiffness_n_per_m", 3e4, 3e7, 1e3, 1e9, "log", (1e6,), None)
OF_COUPONS = EffectParameter("stiffness_n_per_m", 300.0, 1e6, 10.0, 1e8, "log", (1e4,), None)


class SuspensionStiffness(Effect):
    name = "suspension_stiffness"
    part = "a support"
    summary = "a test that is declared free hangs on something stiff"
    citation = "Carne, Griffith and Casias (2007), Proc. IMAC 25"
    confused_with = (
        Confusion("temperature_shift", "the shift falls with the frequency squared"),
        Confusion("local_stiffness", "the split falls with the frequency squared"),
    )
    note = "two radial springs on one axial line of the back of the core, near its ends; stiffness of both together"

    coupon_words = Words(
        "a test that is declared free hangs on something stiff",
        "two equal springs across the body, at the place and at its mirror image about the middle; stiffness of both",
        (Confusion("local_stiffness", "the shift falls with the frequency squared"),),
    )

    tube_words = Words(
        "a test that is declared free hangs on something stiff",
        "two radial springs on one axial line of the tube's outside, near its ends; stiffness of both together",
        (Confusion("local_stiffness", "the split falls with the frequency squared"),),
    )

    def candidates(self, files: StudyFiles) -> tuple[Candidate, ...]:
        return _around(files, STIFFNESS)

    def tube_candidates(self, files: StudyFiles) -> tuple[Candidate, ...]:
        return _around(files, OF_COUPONS)

    def coupon_candidates(self, files: StudyFiles) -> tuple[Candidate, ...]:
        places = places_on(files, half=True)
        return tuple(
            Candidate(self.name, stage.name, (OF_COUPONS, *places), None, test.name)
            for stage in files.study.stages
            for test in stage.tests
            if test.support == FREE and places
        )

    def action(self, candidate: Candidate, values: Mapping[str, float], files: StudyFiles) -> Action:
        stages, tests = frozenset({candidate.stage}), frozenset({str(candidate.test)})
        plan = plan_of(files)
        if plan is not None:
            each = (0.0, 0.0, 0.5 * values["stiffness_n_per_m"])
            springs = tuple(Attachment(place, stiffness=each) for place in plan.both_sides(values))
            return Action(attachments=springs, stages=stages, tests=tests)
        length = ring_of(files).length

        def changes(mesh: HalfPitchMesh, materials: Materials) -> tuple[Change, ...]:
            del materials
            each = np.array([0.5 * values["stiffness_n_per_m"], 0.0, 0.0])
            angles = np.full(2, values["angle_rad"])
            return (point_springs(mesh, angles, np.array([0.1, 0.9]) * length, each),)

        return Action(changes=changes, stages=stages, tests=tests)


def _around(files: StudyFiles, stiffness: EffectParameter) -> tuple[Candidate, ...]:
    """One in every free test of a ring."""
    return tuple(
        Candidate("suspension_stiffness", stage.name, (stiffness, angle()), None, test.name)
        for stage in files.study.stages
        for test in stage.tests
        if test.support == FREE
    )


EFFECT = SuspensionStiffness()
