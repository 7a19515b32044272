"""An axial strip of the back of the core of another modulus: a weld, a notch, a keyway."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from statorhom.conceal.breaks import Strip
from statorhom.conceal.hidden_effect import ANGLE, Drawn, HiddenEffect, Place, is_free
from statorhom.conceal.truth import Case, Finding


def _parameters(place: Place) -> tuple[Drawn, ...]:
    del place
    return (
        Drawn("stiffness_ratio", 0.9, 0.15, "log", is_strength=True),
        ANGLE,
        Drawn("width_deg", 6.0, 16.0),
        Drawn("depth_share", 0.4, 0.8),
    )


def _apply(place: Place, values: Mapping[str, float], rng: np.random.Generator) -> Case:
    del rng
    d = place.case.geometry.dimensions
    depth = values["depth_share"] * (d.outer_radius - d.slot_radius)
    angle, width = np.deg2rad(values["angle_deg"]), np.deg2rad(values["width_deg"])
    strip = Strip(angle, width, depth, values["stiffness_ratio"])
    parameters = {
        "stiffness_ratio": values["stiffness_ratio"],
        "width_deg": values["width_deg"],
        "depth_mm": 1e3 * depth,
        "note": "modulus of an axial strip of the back of the core over that of the core",
    }
    name = place.true_stage.keys.name
    finding = Finding("local_stiffness", name, parameters, angle_deg=values["angle_deg"])
    return place.case.with_broken(place.stage, strip).with_finding(finding)


EFFECT = HiddenEffect("local_stiffness", _parameters, _apply, is_free)
