"""An axial strip of the back of the core is stiffer or softer: a weld, a notch, a keyway."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from statorhom.mesh.hex_mesh import HalfPitchMesh
from statorhom.model.affine import Materials
from statorhom.model.broken.change import Change
from statorhom.model.broken.variations import strip
from statorhom.physics.action import Action, Patch, Training
from statorhom.physics.candidate import Candidate
from statorhom.physics.effect import Confusion, Effect, Words
from statorhom.physics.parameter import EffectParameter, angle
from statorhom.physics.pieces import yoke_layers
from statorhom.physics.plan import Plan, plan_of
from statorhom.physics.ring import ring_of
from statorhom.study.regions import core_region
from statorhom.study.study import StudyFiles

USUAL_DEPTH = 0.5  # of the yoke
USUAL_WIDTH = 10.0  # degrees
TRAINED = 0.6  # strength of the examples: their fields are those of other strengths too
# radius of a coupon's patch over the mean of its sides: 5 % and 95 % quantile of the prior, limits, and what is usual
RADII, USUAL_RADIUS = (0.05, 0.25, 0.025, 0.5), 0.12
DEPTHS = (0.25, 0.9, 0.1, 1.0)  # of the yoke: 5 % and 95 % quantile of the prior, and limits
WIDTH_DEG = EffectParameter(
    "width_deg", 5.0, 20.0, 2.0, 40.0, "log", (USUAL_WIDTH,), None, usual=USUAL_WIDTH, last=True
)
RATIO = EffectParameter("stiffness_ratio", 0.3, 2.5, 0.02, 12.0, "log", (0.6, 1.6), 1.0)


class LocalStiffness(Effect):
    name = "local_stiffness"
    part = "the back of the core"
    on_tubes = True
    # a strip that is wider and less soft splits modes almost alike, and no edge is sharp: seen on strips of 6 to 16°
    open_by_shape = 0.12
    summary = "an axial strip of the back of the core is stiffer or softer: a weld, notch, keyway or cut-out"
    citation = "Fox (1990), J. Sound Vib. 142, 227 (slightly imperfect rings)"
    confused_with = (
        Confusion(
            "attached_mass", "the antinode of the upper mode lies at the strip; the split grows with order"
        ),
        Confusion("ovality", "several orders r split"),
    )
    note = (
        "modulus of an axial strip of the yoke over that of the core; its width and depth are found as well"
    )

    coupon_words = Words(
        "a part of the body is stiffer or softer: a flaw, a repair, an uneven thickness",
        "stiffness at the middle of a round patch over the declared one; it fades as exp(-r²/2) over its radius",
        (Confusion("attached_mass", "shapes at more points near the place"),),
    )

    tube_words = Words(
        "an axial strip of the tube's wall is stiffer or softer: a seam, a groove, a slot",
        "modulus of an axial strip of the wall's outside over that of the rest; its width and depth are found as well",
        confused_with,
    )

    def candidates(self, files: StudyFiles) -> tuple[Candidate, ...]:
        stages = [stage.name for stage in files.study.stages if stage.tests]
        ring = ring_of(files)
        depth = _depth(1e3 * ring.yoke)
        return tuple(
            Candidate(self.name, name, (RATIO, angle(), depth, WIDTH_DEG), ring.region) for name in stages[:1]
        )

    def coupon_candidates(self, files: StudyFiles) -> tuple[Candidate, ...]:
        plan = plan_of(files)
        stages = [] if plan is None else [stage.name for stage in files.study.stages if stage.tests]
        return tuple(
            Candidate(self.name, name, (RATIO, *plan.places(), _radius(plan))) for name in stages if plan
        )

    def reported(self, candidate: Candidate, values: Mapping[str, float]) -> dict[str, float | str]:
        # a patch has a radius, a strip the others
        details = {name: values[name] for name in ("radius_mm", "width_deg", "depth_mm") if name in values}
        return super().reported(candidate, values) | details

    def action(self, candidate: Candidate, values: Mapping[str, float], files: StudyFiles) -> Action:
        plan = plan_of(files)
        if plan is not None:
            x, y, _ = plan.on_top(values)
            patch = Patch((x, y), 1e-3 * values["radius_mm"], values["stiffness_ratio"])
            return Action(patches=(patch,), stages=frozenset({candidate.stage}))
        yoke = ring_of(files).yoke

        def changes(mesh: HalfPitchMesh, materials: Materials) -> tuple[Change, ...]:
            core = yoke_layers(mesh, materials[core_region(materials)], mesh.outer_radius - yoke)
            width, depth = np.radians(values["width_deg"]), 1e-3 * values["depth_mm"]
            ratio, place = values["stiffness_ratio"], values["angle_rad"]
            return (strip(core, place, width=width, depth=depth, ratio=ratio),)

        def examples(mesh: HalfPitchMesh, materials: Materials) -> tuple[tuple[Change, ...], ...]:
            core = yoke_layers(mesh, materials[core_region(materials)], mesh.outer_radius - yoke)
            places, depth = np.array([0.0, 0.5, 1.0]) * np.pi / mesh.slots, USUAL_DEPTH * yoke
            width = np.radians(USUAL_WIDTH)
            return tuple((strip(core, place, width=width, depth=depth, ratio=TRAINED),) for place in places)

        return Action(changes=changes, training=Training(self.name, examples))


def _depth(yoke_mm: float) -> EffectParameter:
    """How deep the strip reaches, of a yoke."""
    return _detail("depth_mm", DEPTHS, USUAL_DEPTH, yoke_mm)


def _radius(plan: Plan) -> EffectParameter:
    """How wide the patch is, of a body's sides."""
    return _detail("radius_mm", RADII, USUAL_RADIUS, 1e3 * float(np.sqrt(np.prod(plan.lengths))))


def _detail(name: str, shares: tuple[float, ...], usual: float, size: float) -> EffectParameter:
    low90, high90, lower, upper = (share * size for share in shares)
    return EffectParameter(
        name, low90, high90, lower, upper, "log", (usual * size,), None, usual=usual * size
    )


EFFECT = LocalStiffness()
