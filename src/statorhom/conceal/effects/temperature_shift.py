"""A test was run warmer or colder than the others."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from statorhom.conceal.hidden_effect import Drawn, HiddenEffect, Place
from statorhom.conceal.truth import Case, Finding

STEEL, RESIN = (-4e-4, -2e-4), -1e-2  # relative change of stiffness per kelvin
SOFTEST = 0.1


def _parameters(place: Place) -> tuple[Drawn, ...]:
    wound = "winding" in place.true_stage.materials
    return (Drawn("temperature_k", 2.0 if wound else 8.0, 40.0 if wound else 90.0, "log", is_strength=True),)


def _apply(place: Place, values: Mapping[str, float], rng: np.random.Generator) -> Case:
    rise, steel = values["temperature_k"], float(rng.uniform(*STEEL))
    factors = {
        region: max(1 + (RESIN if region in ("winding", "overhang") else steel) * rise, SOFTEST)
        for region in place.true_stage.materials
    }
    case = place.case.with_test(place.stage, place.test, stiffness_factor=factors)
    parameters = {
        "temperature_k": rise,
        "steel_per_k": steel,
        "winding_per_k": RESIN,
        "note": "above that of the other tests",
    }
    name = place.true_stage.keys.name
    return case.with_finding(Finding("temperature_shift", name, parameters, test=place.true_test.name))


def _fits(place: Place) -> bool:
    earlier = any(stage.tests for stage in place.case.stages[: place.stage])
    return place.true_test.declared is None and (earlier or place.test > 0)


EFFECT = HiddenEffect("temperature_shift", _parameters, _apply, _fits)
