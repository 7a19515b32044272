"""A lump on the back of the core that is not in the model, and was not on the scale."""

from __future__ import annotations

from collections.abc import Mapping

from statorhom.mesh.hex_mesh import HalfPitchMesh
from statorhom.model.affine import Materials
from statorhom.model.broken.attachments import footed_lump
from statorhom.model.broken.change import Change
from statorhom.physics.action import Action, Attachment
from statorhom.physics.candidate import Candidate
from statorhom.physics.effect import Confusion, Effect, Words
from statorhom.physics.parameter import EffectParameter, angle, height
from statorhom.physics.plan import places_on, plan_of
from statorhom.physics.ring import ring_of
from statorhom.study.study import StudyFiles

# Terminal boxes, lugs and weights: how high their centre of gravity lies decides how much the tangential motion, and
# with it the split of the lowest orders, counts; the mass is not known better than that.
USUAL_MM = 8.0
HEIGHT_MM = EffectParameter("cog_height_mm", 3.0, 20.0, 0.5, 60.0, "log", (USUAL_MM,), None, usual=USUAL_MM)
FOOT = 1.5  # side of the foot over the height of the centre of gravity
LARGEST = 0.2  # of the stage's mass


class AttachedMass(Effect):
    name = "attached_mass"
    part = "the back of the core"
    on_tubes = True
    open_by_shape = 0.08  # foot and height of the lump are not known: seen on lumps of 30 g to 1 kg
    summary = "a lump on the back of the core is not in the model"
    citation = "Fox (1990), J. Sound Vib. 142, 227; Soedel (2004), Vibrations of Shells and Plates"
    confused_with = (
        Confusion(
            "local_stiffness", "the antinode of the lower mode lies at a mass, of the upper at a stiffness"
        ),
        Confusion("ovality", "several orders r split"),
    )
    note = (
        "a rigid cube on a square foot 1.5 times as wide as its centre of gravity is high, not on the scale"
    )

    coupon_words = Words(
        "a lump on the body is not in the model",
        "a point mass on the upper face, not on the scale",
        (
            Confusion(
                "local_stiffness", "shapes at more points near the place; frequencies rise at a stiffer patch"
            ),
            Confusion("suspension_stiffness", "the shift falls with the frequency squared"),
        ),
    )

    tube_words = Words(
        "a lump on the outside of the tube is not in the model",
        note,
        confused_with,
    )

    def candidates(self, files: StudyFiles) -> tuple[Candidate, ...]:
        ring = ring_of(files)
        found = []
        for stage in files.study.stages:
            if not stage.tests:
                continue
            mass = _share_of(stage.mass_kg)
            # foot and all on the surface
            place = height(ring.length)
            found.append(Candidate(self.name, stage.name, (mass, HEIGHT_MM, angle(), place), ring.region))
        return tuple(found)

    def coupon_candidates(self, files: StudyFiles) -> tuple[Candidate, ...]:
        places = places_on(files)
        return tuple(
            Candidate(self.name, stage.name, (_share_of(stage.mass_kg), *places), repeats=True)
            for stage in files.study.stages
            if stage.tests and places
        )

    def coupon_pairs(self, files: StudyFiles) -> tuple[Candidate, ...]:
        places = places_on(files, half=True)
        return tuple(
            Candidate(self.name, stage.name, (_share_of(stage.mass_kg), *places), both_sides=True)
            for stage in files.study.stages
            if stage.tests and places
        )

    def action(self, candidate: Candidate, values: Mapping[str, float], files: StudyFiles) -> Action:
        plan = plan_of(files)
        if plan is not None:
            places = plan.both_sides(values) if candidate.both_sides else (plan.on_top(values),)
            lumps = tuple(Attachment(place, values["mass_kg"]) for place in places)
            return Action(attachments=lumps, stages=frozenset({candidate.stage}))
        length = ring_of(files).length
        above = values.get("cog_height_mm", USUAL_MM) / 1e3
        foot = min(FOOT * above, 0.5 * length)
        z = min(max(values["z_m"], 0.51 * foot), length - 0.51 * foot)

        def changes(mesh: HalfPitchMesh, materials: Materials) -> tuple[Change, ...]:
            del materials
            lump = footed_lump(mesh, values["angle_rad"], z, values["mass_kg"], foot=foot, height=above)
            return (lump,)

        return Action(changes=changes, stages=frozenset({candidate.stage}))


def _share_of(m: float) -> EffectParameter:
    return EffectParameter("mass_kg", 0.003 * m, 0.05 * m, 1e-4 * m, LARGEST * m, "log", (0.01 * m,), None)


EFFECT = AttachedMass()
