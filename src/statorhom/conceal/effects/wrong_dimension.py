"""A dimension is typed wrongly."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from statorhom.conceal.hidden_effect import Drawn, HiddenEffect, Place
from statorhom.conceal.truth import Case, Finding

KEYS = (("core", "yoke_thickness_mm"), ("core", "length_mm"), ("slots", "tooth_width_mm"))


def _parameters(place: Place) -> tuple[Drawn, ...]:
    del place
    return (Drawn("error", 0.01, 0.12, "log", is_strength=True),)


def _apply(place: Place, values: Mapping[str, float], rng: np.random.Generator) -> Case:
    case = place.case
    known = [(s, k) for s, k in KEYS if k in case.geometry_file[s]]
    section, key = known[int(rng.integers(len(known)))]
    right = case.geometry_file[section][key]
    typed = round(right * (1 + float(rng.choice([-1.0, 1.0])) * values["error"]), 2)
    file = {**case.geometry_file, section: {**case.geometry_file[section], key: typed}}
    first = next(stage for stage in case.stages if stage.tests)
    parameters = {"input": key, "value": right, "in_file": typed}
    return replace(case, geometry_file=file).with_finding(Finding("wrong_input", first.keys.name, parameters))


def _fits(place: Place) -> bool:
    return place.test == 0 and place.stage == next(i for i, s in enumerate(place.case.stages) if s.tests)


EFFECT = HiddenEffect("wrong_dimension", _parameters, _apply, _fits)
