"""The roving accelerometer weighs something."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from statorhom.conceal.hidden_effect import Drawn, HiddenEffect, Place
from statorhom.conceal.truth import Case, Finding

SMALLEST, LARGEST = 0.0005, 0.008  # of the stage's mass


def _parameters(place: Place) -> tuple[Drawn, ...]:
    mass = place.true_stage.scale_kg
    return (Drawn("mass_kg", SMALLEST * mass, LARGEST * mass, "log", is_strength=True),)


def _apply(place: Place, values: Mapping[str, float], rng: np.random.Generator) -> Case:
    del rng
    test = place.true_test
    finding = Finding("sensor_mass", place.true_stage.keys.name, dict(values), test=test.name)
    case = place.case.with_test(place.stage, place.test, sensor_mass_kg=values["mass_kg"])
    return case.with_finding(finding)


def _fits(place: Place) -> bool:
    return not place.true_test.is_table


EFFECT = HiddenEffect("sensor_mass", _parameters, _apply, _fits)
