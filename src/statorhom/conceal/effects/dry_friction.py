"""A contact slips at large amplitudes: a series of force levels shows it."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from statorhom.conceal.hidden_effect import Drawn, HiddenEffect, Place
from statorhom.conceal.truth import Case, Finding, Slip


def _parameters(place: Place) -> tuple[Drawn, ...]:
    force = place.true_test.force_n
    return (
        Drawn("slip_force_n", 0.05 * force, 0.5 * force, "log"),
        Drawn("stiffness_share", 0.005, 0.08, "log", is_strength=True),
    )


def _apply(place: Place, values: Mapping[str, float], rng: np.random.Generator) -> Case:
    del rng
    case, stage = place.case, place.true_stage
    slip = Slip(values["slip_force_n"], values["stiffness_share"])
    for t in range(len(stage.tests)):
        case = case.with_test(place.stage, t, slip=slip)
    parameters = {
        "slip_force_n": values["slip_force_n"],
        "stiffness_share": values["stiffness_share"],
        "note": "Jenkins element of every mode on its own, which carries this share of the modal stiffness",
    }
    return case.with_finding(Finding("dry_friction", stage.keys.name, parameters))


def _fits(place: Place) -> bool:
    levels = {test.force_n for test in place.true_stage.tests if not test.is_table}
    return place.test == 0 and len(levels) > 1


EFFECT = HiddenEffect("dry_friction", _parameters, _apply, _fits)
