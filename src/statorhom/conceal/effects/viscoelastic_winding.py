"""The winding's modulus rises with frequency."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from statorhom.conceal.hidden_effect import Drawn, HiddenEffect, Place, is_wound
from statorhom.conceal.truth import Case, Finding


def _parameters(place: Place) -> tuple[Drawn, ...]:
    del place
    return (Drawn("modulus_slope_per_decade", 0.1, 1.2, "log", is_strength=True),)


def _apply(place: Place, values: Mapping[str, float], rng: np.random.Generator) -> Case:
    del rng
    slope = values["modulus_slope_per_decade"]
    case = place.case.with_stage(place.stage, modulus_slope=dict.fromkeys(("winding", "overhang"), slope))
    return case.with_finding(Finding("viscoelastic_winding", place.true_stage.keys.name, dict(values)))


EFFECT = HiddenEffect("viscoelastic_winding", _parameters, _apply, is_wound)
