"""The overhang is not the material in the slots."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from statorhom.conceal.hidden_effect import Drawn, HiddenEffect, Place, is_wound
from statorhom.conceal.truth import Case, Finding


def _parameters(place: Place) -> tuple[Drawn, ...]:
    del place
    return (Drawn("stiffness_ratio", 0.85, 0.12, "log", is_strength=True),)


def _apply(place: Place, values: Mapping[str, float], rng: np.random.Generator) -> Case:
    del rng
    stage = place.true_stage
    soft = stage.materials["winding"].scaled(values["stiffness_ratio"])
    case = place.case.with_stage(place.stage, materials={**stage.materials, "overhang": soft})
    return case.with_finding(Finding("end_winding_stiffness", stage.keys.name, dict(values)))


def _fits(place: Place) -> bool:
    materials = place.true_stage.materials
    return is_wound(place) and materials["overhang"] == materials["winding"]


EFFECT = HiddenEffect("end_winding_stiffness", _parameters, _apply, _fits)
