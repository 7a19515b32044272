"""Only part of the winding's mass moves with the teeth."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from statorhom.conceal.hidden_effect import Drawn, HiddenEffect, Place, is_wound
from statorhom.conceal.truth import Case, Finding


def _parameters(place: Place) -> tuple[Drawn, ...]:
    del place
    return (Drawn("participating_fraction", 0.95, 0.3, "linear", is_strength=True),)


def _apply(place: Place, values: Mapping[str, float], rng: np.random.Generator) -> Case:
    del rng
    stage, share = place.true_stage, values["participating_fraction"]
    light = {
        region: replace(stage.materials[region], density=share * stage.materials[region].density)
        for region in ("winding", "overhang")
    }
    case = place.case.with_stage(place.stage, materials={**stage.materials, **light})
    parameters = {**values, "note": "the rest of the winding's mass is absent from the dynamics"}
    return case.with_finding(Finding("loose_winding_mass", stage.keys.name, parameters))


EFFECT = HiddenEffect("loose_winding_mass", _parameters, _apply, is_wound)
