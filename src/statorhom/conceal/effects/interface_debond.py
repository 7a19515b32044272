"""Winding and teeth have lost contact over an arc."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from statorhom.conceal.breaks import LostContact
from statorhom.conceal.hidden_effect import ANGLE, Drawn, HiddenEffect, Place, is_wound
from statorhom.conceal.truth import Case, ContactLaw, Finding

INTACT = 3e13  # N/m³


def _parameters(place: Place) -> tuple[Drawn, ...]:
    del place
    return (
        Drawn("arc_deg", 15.0, 180.0, "log", is_strength=True),
        Drawn("contact_ratio", 3e-3, 1e-4, "log"),
        ANGLE,
    )


def _apply(place: Place, values: Mapping[str, float], rng: np.random.Generator) -> Case:
    del rng
    stage = place.true_stage
    middle, width = np.deg2rad(values["angle_deg"]), np.deg2rad(values["arc_deg"])
    lost = LostContact(middle - width / 2, middle + width / 2, values["contact_ratio"])
    case = place.case.with_stage(
        place.stage, contact=ContactLaw(("winding", "overhang"), INTACT, INTACT), breaks=(*stage.breaks, lost)
    )
    parameters = {
        "arc_deg": values["arc_deg"],
        "contact_ratio": values["contact_ratio"],
        "note": "zero-thickness contact of winding and core, 3e13 N/m3 where intact",
    }
    finding = Finding("interface_debond", stage.keys.name, parameters, angle_deg=values["angle_deg"])
    return case.with_finding(finding)


EFFECT = HiddenEffect("interface_debond", _parameters, _apply, is_wound)
