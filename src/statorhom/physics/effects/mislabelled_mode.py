"""A mode carries the wrong order in its table."""

from __future__ import annotations

from collections.abc import Mapping

from statorhom.physics.action import Action
from statorhom.physics.candidate import Candidate
from statorhom.physics.effect import Confusion, Effect
from statorhom.study.study import StudyFiles

ORDERS, NODE_PLANES = range(6), range(4)


class MislabelledMode(Effect):
    name = "mislabelled_mode"
    part = "the files"
    on_tubes = True
    summary = "a mode carries the wrong order in its table"
    citation = "Allemang (2003), Sound & Vibration 37(8), 14"
    confused_with = (Confusion("interlaminar_shear", "a second mode of the same kind"),)

    def candidates(self, files: StudyFiles) -> tuple[Candidate, ...]:
        return tuple(
            Candidate(
                self.name, stage.name, (), None, test.name,
                (("mode", mode.label), ("order", r), ("axial", n)),
            )
            for stage in files.study.stages
            for test in stage.tests
            if test.name in files.tables and test.modal_table is not None
            for mode in files.tables[test.name].modes
            if mode.order is not None
            for r in ORDERS
            for n in NODE_PLANES
            if (r, n) != (mode.order, mode.axial) and r + n > 1
        )  # fmt: skip

    def action(self, candidate: Candidate, values: Mapping[str, float], files: StudyFiles) -> Action:
        key = candidate.chosen
        name = int(key["order"]), int(key["axial"])
        return Action(names={(str(candidate.test), str(key["mode"])): name})


EFFECT = MislabelledMode()
