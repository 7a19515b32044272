"""Outside the library: a rod from one point of the surface to the ground, stiff along a slanted direction only."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from statorhom.conceal.breaks import Tether
from statorhom.conceal.hidden_effect import ANGLE, Drawn, HiddenEffect, Place, is_free
from statorhom.conceal.truth import Case, Finding

PER_KG = (3e6, 6e7)  # N/m per kilogram of the stator


def _parameters(place: Place) -> tuple[Drawn, ...]:
    mass = place.true_stage.scale_kg
    return (
        Drawn("stiffness_n_per_m", PER_KG[0] * mass, PER_KG[1] * mass, "log", is_strength=True),
        ANGLE,
        Drawn("z_share", 0.05, 0.4),
    )


def _apply(place: Place, values: Mapping[str, float], rng: np.random.Generator) -> Case:
    z = values["z_share"] * place.case.geometry.dimensions.length
    direction = (0.2, 1.0, float(rng.uniform(0.5, 1.5)))
    angle = float(np.deg2rad(values["angle_deg"]))
    tether = Tether(angle, z, direction, values["stiffness_n_per_m"])
    finding = Finding(
        "outside_tether",
        place.true_stage.keys.name,
        {"stiffness_n_per_m": values["stiffness_n_per_m"], "direction": list(direction)},
        test=place.true_test.name,
        angle_deg=values["angle_deg"],
        z_mm=1e3 * z,
    )
    test = place.true_test
    return place.case.with_test(place.stage, place.test, breaks=(*test.breaks, tether)).with_finding(finding)


EFFECT = HiddenEffect("outside_tether", _parameters, _apply, is_free, in_library=False)
