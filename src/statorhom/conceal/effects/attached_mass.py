"""A lump on the back of the core, not on the scale."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from statorhom.conceal.breaks import Lump
from statorhom.conceal.hidden_effect import ANGLE, Drawn, HiddenEffect, Place, is_free
from statorhom.conceal.truth import Case, Finding

SMALLEST, LARGEST = 0.002, 0.05  # of the stage's mass


def _parameters(place: Place) -> tuple[Drawn, ...]:
    mass, length_mm = place.true_stage.scale_kg, 1e3 * place.case.geometry.dimensions.length
    return (
        Drawn("mass_kg", SMALLEST * mass, LARGEST * mass, "log", is_strength=True),
        ANGLE,
        Drawn("z_mm", 0.1 * length_mm, 0.9 * length_mm),
        Drawn("foot_mm", 8.0, 16.0),
    )


def _apply(place: Place, values: Mapping[str, float], rng: np.random.Generator) -> Case:
    length_mm = 1e3 * place.case.geometry.dimensions.length
    foot_mm = min(values["foot_mm"], 0.15 * length_mm)
    height_mm = float(rng.uniform(0.5, 0.8)) * foot_mm
    lump = Lump(
        np.deg2rad(values["angle_deg"]),
        values["z_mm"] / 1e3,
        values["mass_kg"],
        foot_mm / 1e3,
        height_mm / 1e3,
    )
    stage = place.true_stage
    finding = Finding(
        "attached_mass",
        stage.keys.name,
        {
            "mass_kg": values["mass_kg"],
            "foot_mm": foot_mm,
            "cog_height_mm": height_mm,
            "note": "the stage was weighed without the lump",
        },
        angle_deg=values["angle_deg"],
        z_mm=values["z_mm"],
    )
    return place.case.with_stage(place.stage, breaks=(*stage.breaks, lump)).with_finding(finding)


EFFECT = HiddenEffect("attached_mass", _parameters, _apply, is_free)
