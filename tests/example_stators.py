"""Stators of every slot shape, for the tests of geometry and mesh."""

from pathlib import Path

from statorhom.geometry import stator_geometry
from statorhom.study.geometry_file import GeometryFile

CORE = {
    "outer_diameter_mm": 120.0,
    "bore_diameter_mm": 70.0,
    "length_mm": 80.5,
    "yoke_thickness_mm": 9.15,
}
WINDING = {"overhang_length_mm": 25.0}
FRAME = {"inner_diameter_mm": 120.0, "outer_diameter_mm": 130.0, "length_mm": 150.0, "offset_mm": -34.75}
MACHINE = {"shield_thickness_mm": 8.0, "shield_bore_diameter_mm": 40.0}

PARALLEL_TOOTH = {"shape": "parallel_tooth", "count": 36, "tooth_width_mm": 3.0}
SEMI_CLOSED = {
    "shape": "semi_closed",
    "count": 36,
    "tooth_width_mm": 3.0,
    "opening_width_mm": 1.5,
    "tip_height_mm": 0.8,
}
SLOTS = {
    "parallel_tooth": PARALLEL_TOOTH,
    "semi_closed": SEMI_CLOSED,
    "semi_closed with wedge": SEMI_CLOSED | {"wedge_height_mm": 1.0},
    "round_bottom": {"shape": "round_bottom", "count": 36, "tooth_width_mm": 3.0},
    "wide round_bottom": {"shape": "round_bottom", "count": 12, "tooth_width_mm": 6.0},
    "parallel_slot": {"shape": "parallel_slot", "count": 36, "slot_width_mm": 2.8},
    "few slots": {"shape": "parallel_tooth", "count": 5, "tooth_width_mm": 14.0},
    "none": {"shape": "none", "count": 36},
}
STEPS = {
    "stack": ("stack",),
    "wound": ("stack", "wound"),
    "impregnated": ("stack", "wound", "impregnated"),
    "framed": ("stack", "wound", "impregnated", "framed"),
    "machine": ("stack", "wound", "impregnated", "framed", "machine"),
}
# a plain ring takes no winding
STEPS_OF_RING = {
    "stack": ("stack",),
    "framed": ("stack", "framed"),
    "machine": ("stack", "framed", "machine"),
}
EVERY_STEP = [
    (name, kinds) for name in SLOTS for kinds in (STEPS_OF_RING if name == "none" else STEPS).values()
]


def stator(slots=PARALLEL_TOOTH, *, path="stator.toml", **tables):
    """Geometry of a file with these slots; keywords replace (keys of) tables, None removes one."""
    file = {"core": CORE, "winding": WINDING, "frame": FRAME, "machine": MACHINE}
    for name, table in tables.items():
        file[name] = None if table is None else file[name] | table
    file = {name: table for name, table in file.items() if table is not None}
    checked = GeometryFile.model_validate({"schema": 1, "name": "example", "slots": slots, **file})
    return stator_geometry(checked, Path(path))
