"""What results.json says of the tested object's geometry."""

from __future__ import annotations

import math

from statorhom.geometry.block import BlockGeometry
from statorhom.geometry.tested_object import ObjectGeometry
from statorhom.geometry.wing import WingGeometry
from statorhom.study.geometry_file import GeometryFile
from statorhom.study.object_file import ObjectFile


def described(drawing: ObjectFile, geometry: ObjectGeometry) -> dict[str, float | int | str]:
    """Name and main dimensions of a stator, a block, a tube or a wing."""
    name = drawing.name
    if isinstance(geometry, BlockGeometry):
        sizes = [1e3 * size for size in geometry.size]
        height = "thickness_mm" if geometry.region == "plate" else "height_mm"
        return {
            "name": name,
            "kind": drawing.kind,
            "length_mm": sizes[0],
            "width_mm": sizes[1],
            height: sizes[2],
        }
    if isinstance(geometry, WingGeometry):
        plan = geometry.plan
        return {
            "name": name,
            "kind": drawing.kind,
            "span_mm": 2e3 * plan.half_span,
            "root_chord_mm": 1e3 * plan.root_chord,
            "tip_chord_mm": 1e3 * plan.tip_chord,
            "sweep_deg": math.degrees(plan.sweep),
        }
    d = geometry.dimensions
    lengths = {
        "outer_diameter_mm": 2e3 * d.outer_radius,
        "bore_diameter_mm": 2e3 * d.bore_radius,
        "length_mm": 1e3 * d.length,
    }
    if isinstance(drawing, GeometryFile):
        return {"name": name, "slots": d.slots, "shape": drawing.slots.shape, **lengths}
    return {"name": name, "kind": drawing.kind, **lengths}
