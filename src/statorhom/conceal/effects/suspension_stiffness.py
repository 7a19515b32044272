"""A test that is declared free hangs on something stiff."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from statorhom.conceal.breaks import Cords
from statorhom.conceal.hidden_effect import ANGLE, Drawn, HiddenEffect, Place, is_free
from statorhom.conceal.truth import Case, Finding

PER_KG = (1e5, 3e6)  # N/m per kilogram of the stator


def _parameters(place: Place) -> tuple[Drawn, ...]:
    mass = place.true_stage.scale_kg
    return (
        Drawn("stiffness_n_per_m", PER_KG[0] * mass, PER_KG[1] * mass, "log", is_strength=True),
        ANGLE,
    )


def _apply(place: Place, values: Mapping[str, float], rng: np.random.Generator) -> Case:
    del rng
    length, angle = place.case.geometry.dimensions.length, float(np.deg2rad(values["angle_deg"]))
    # a rope is soft across
    each = 0.5 * values["stiffness_n_per_m"]
    cords = Cords((angle, angle), (0.12 * length, 0.88 * length), (each, 0.02 * each, 0.02 * each))
    test = place.true_test
    finding = Finding(
        "suspension_stiffness",
        place.true_stage.keys.name,
        {
            "stiffness_n_per_m": values["stiffness_n_per_m"],
            "note": "radial, of two cords on one line together",
        },
        test=test.name,
        angle_deg=values["angle_deg"],
    )
    return place.case.with_test(place.stage, place.test, breaks=(*test.breaks, cords)).with_finding(finding)


EFFECT = HiddenEffect("suspension_stiffness", _parameters, _apply, is_free)
