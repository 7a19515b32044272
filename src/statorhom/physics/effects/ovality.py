"""The yoke's stiffness varies around the stator as one cosine."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from statorhom.mesh.hex_mesh import HalfPitchMesh
from statorhom.model.affine import Materials
from statorhom.model.broken.change import Change
from statorhom.model.broken.variations import wave
from statorhom.physics.action import Action
from statorhom.physics.candidate import Candidate
from statorhom.physics.effect import Confusion, Effect, Words
from statorhom.physics.parameter import EffectParameter, angle
from statorhom.physics.pieces import region_pieces
from statorhom.physics.ring import ring_of
from statorhom.study.regions import core_region
from statorhom.study.study import StudyFiles

# a ring splits order r by the harmonic 2 r alone; odd ones split nothing
HARMONICS = (2, 4, 6, 8)
AMPLITUDE = EffectParameter("relative_amplitude", 0.003, 0.05, 1e-4, 0.3, "log", (0.01,), None)


class Ovality(Effect):
    name = "ovality"
    part = "the back of the core"
    on_tubes = True
    summary = "the yoke's stiffness or thickness varies around the stator as cos n(θ − α)"
    citation = "Hwang, Fox and McWilliam (1999), J. Sound Vib. 220, 497 (rings of varying profile)"
    confused_with = (
        Confusion("attached_mass", "one order r alone splits"),
        Confusion("local_stiffness", "one order r alone splits"),
    )
    note = "of the yoke's stiffness, its mass unchanged; the angle is a maximum of stiffness"

    tube_words = Words(
        "the wall's stiffness or thickness varies around the tube as cos n(θ − α)",
        "of the wall's stiffness, its mass unchanged; the angle is a maximum of stiffness",
        confused_with,
    )

    def candidates(self, files: StudyFiles) -> tuple[Candidate, ...]:
        core = ring_of(files).region
        stages = [stage.name for stage in files.study.stages if stage.tests]
        return tuple(
            Candidate(self.name, name, (AMPLITUDE, angle(2 * np.pi / n)), core, choice=(("harmonic", n),))
            for name in stages[:1]
            for n in HARMONICS
        )

    def action(self, candidate: Candidate, values: Mapping[str, float], files: StudyFiles) -> Action:
        inner = ring_of(files).slot_radius
        harmonic = int(candidate.chosen["harmonic"])

        def changes(mesh: HalfPitchMesh, materials: Materials) -> tuple[Change, ...]:
            core = core_region(materials)
            yoke = region_pieces(mesh, core, materials[core])
            size, place = values["relative_amplitude"], values["angle_rad"]
            return (wave(mesh, yoke, place, harmonic=harmonic, amplitude=size, inner=inner),)

        return Action(changes=changes)


EFFECT = Ovality()
