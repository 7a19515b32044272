"""Machines and studies of the blind benchmark: drawn, each of another size, slot count and slot shape."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from statorhom.geometry.stator import stator_geometry
from statorhom.study.atomic import write_text
from statorhom.study.geometry_file import GeometryFile
from statorhom.study.toml_text import toml_text

SLOTS = (24, 30, 36, 42, 48, 54, 60)
SHAPES = ("parallel_tooth", "parallel_slot", "semi_closed")
CLAMP_DEG = (30.0, 60.0)  # between the two lines of a clamp
FORCES_N = (2.0, 10.0, 50.0)
FREE: Mapping[str, Any] = {"support": "free"}
TI = "transversely_isotropic"


def machine(number: int) -> dict[str, Any]:
    """Geometry file of a machine; equal numbers give equal machines."""
    rng = np.random.default_rng([2026, number])
    outer = float(np.round(rng.uniform(95, 230)))
    slots = int(rng.choice(SLOTS))
    bore = float(np.round(outer * rng.uniform(0.55, 0.66)))
    yoke = float(np.round((outer - bore) / 2 * rng.uniform(0.36, 0.52), 2))
    length = float(np.round(outer * rng.uniform(0.45, 0.85), 1))
    pitch_mm = np.pi * bore / slots
    shape = SHAPES[number % len(SHAPES)]
    return {
        "schema": 1,
        "name": f"blind machine {number}",
        "core": {
            "outer_diameter_mm": outer,
            "bore_diameter_mm": bore,
            "length_mm": length,
            "yoke_thickness_mm": yoke,
        },
        "slots": {"count": slots, "shape": shape, **_slot(shape, pitch_mm)},
        "winding": {"overhang_length_mm": float(np.round(outer * rng.uniform(0.15, 0.22), 1))},
        "frame": {
            "inner_diameter_mm": outer,
            "outer_diameter_mm": float(np.round(outer * 1.09, 1)),
            "length_mm": float(np.round(length * 1.3, 1)),
            "offset_mm": float(np.round(-0.15 * length, 1)),
        },
    }


def _slot(shape: str, pitch_mm: float) -> dict[str, float]:
    tooth = float(np.round(0.48 * pitch_mm, 2))
    if shape == "parallel_slot":
        return {"slot_width_mm": float(np.round(0.5 * pitch_mm, 2))}
    if shape == "semi_closed":
        return {
            "tooth_width_mm": tooth,
            "opening_width_mm": float(np.round(0.25 * pitch_mm, 2)),
            "tip_height_mm": 0.9,
        }
    return {"tooth_width_mm": tooth}


def study(template: str, seed: int) -> dict[str, Any]:
    """Study file of a template: which steps and tests there are. The data that its tests name need not exist.

    Parameters
    ----------
    template : "stack", "clamped", "wound", "chain", "levels" or "framed".
    seed : of the clamp's angles.
    """
    rng = np.random.default_rng([77, seed])
    first = float(np.round(rng.uniform(0, 360)))
    kinds = {
        "wound": ("stack", "wound"),
        "chain": ("stack", "wound", "impregnated"),
        "framed": ("stack", "framed"),
    }
    table: dict[str, Any] = {"schema": 1, "name": template, "geometry": "geometry.toml"}
    if template == "clamped":
        angles = [first, first + float(np.round(rng.uniform(*CLAMP_DEG)))]
        table["supports"] = [{"name": "clamped", "kind": "lines", "angles_deg": angles, "declared": "rigid"}]
    stages = [_stage(kind) for kind in kinds.get(template, ("stack",))]
    if template == "clamped":
        stages[0]["tests"].append({"name": "stack-clamped", "support": "clamped", "frf": "-.uff"})
    if template == "levels":
        stages[0]["tests"] = [
            {"name": f"stack-{force:g}n", **FREE, "frf": "-.uff", "force_level_n": force}
            for force in FORCES_N
        ]
    return {**table, "stages": stages}


def _stage(kind: str) -> dict[str, Any]:
    region = {"stack": "lamination", "framed": "frame"}.get(kind, "winding")
    symmetry = "isotropic" if kind == "framed" else TI
    mass = 1.0 + ("stack", "wound", "impregnated", "framed").index(
        kind
    )  # typed anew when the truth is weighed
    return {
        "name": kind,
        "kind": kind,
        "mass_kg": mass,
        "mass_sd_kg": 0.002,
        "model": {region: symmetry},
        "tests": [{"name": f"{kind}-free", **FREE, "frf": "-.uff"}],
    }


def write_template(folder: Path, template: str, number: int, seed: int) -> Path:
    """Write the study and its geometry; the study's path."""
    geometry = machine(number)
    stator_geometry(GeometryFile.model_validate(geometry), folder)
    write_text(folder / "geometry.toml", toml_text(geometry))
    write_text(folder / "template.toml", toml_text(study(template, seed)))
    return folder / "template.toml"
