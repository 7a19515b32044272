"""The axial contact pressure, and with it G_rz and E_z, varies along the stack."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial

from statorhom.mesh.hex_mesh import HalfPitchMesh
from statorhom.model.affine import Materials
from statorhom.model.assembly import HOOKE_ENTRIES
from statorhom.model.broken.change import Change
from statorhom.model.broken.variations import gradient
from statorhom.physics.action import Action, Training
from statorhom.physics.candidate import Candidate
from statorhom.physics.effect import Confusion, Effect
from statorhom.physics.parameter import EffectParameter
from statorhom.physics.pieces import region_pieces
from statorhom.study.study import StudyFiles

RATIO = EffectParameter("G_rz_end_ratio", 0.15, 3.0, 0.02, 20.0, "log", (0.5, 1.8), 1.0)
TRAINED = 0.4  # strength of the example: its fields are those of other strengths too
# entries that the contact between sheets carries: normal along z, and the two transverse shears
CONTACT = ((2, 2), (3, 3), (4, 4))


class StackPressureGradient(Effect):
    name = "stack_pressure_gradient"
    summary = "the axial contact pressure, and with it G_rz and E_z, varies along the stack"
    citation = "Johnson (1985), Contact Mechanics, ch. 13 (rough surfaces)"
    confused_with = (Confusion("interlaminar_shear", "the shapes along z"),)
    note = "G_rz and C33 at the end z = L over those at z = 0, linear in between, their mean unchanged"

    def candidates(self, files: StudyFiles) -> tuple[Candidate, ...]:
        stages = [stage.name for stage in files.study.stages if stage.tests]
        if files.study.symmetry(0, "lamination") == "isotropic":
            return ()
        return tuple(Candidate(self.name, name, (RATIO,), "lamination") for name in stages[:1])

    def action(self, candidate: Candidate, values: Mapping[str, float], files: StudyFiles) -> Action:
        length = files.geometry.core.length_mm / 1e3

        def varied(mesh: HalfPitchMesh, materials: Materials, ratio: float) -> tuple[Change, ...]:
            used = tuple(entry in CONTACT for entry in HOOKE_ENTRIES)
            pieces = region_pieces(mesh, "lamination", materials["lamination"], used)
            slope = (ratio - 1.0) / (ratio + 1.0)
            return (gradient(mesh, pieces, ("lamination",), lambda z: slope * (2 * z / length - 1.0)),)

        return Action(
            changes=partial(varied, ratio=values["G_rz_end_ratio"]),
            training=Training(self.name, partial(varied, ratio=TRAINED)),
        )


EFFECT = StackPressureGradient()
