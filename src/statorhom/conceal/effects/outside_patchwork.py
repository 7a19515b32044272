"""Outside the library: a random field of thickness, so that stiffness and mass differ from pitch to pitch."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from statorhom.conceal.breaks import Patchwork
from statorhom.conceal.hidden_effect import Drawn, HiddenEffect, Place, is_free
from statorhom.conceal.truth import Case, Finding

HARMONICS = range(2, 13)


def _parameters(place: Place) -> tuple[Drawn, ...]:
    del place
    return (Drawn("relative_sd", 0.005, 0.08, "log", is_strength=True),)


def _apply(place: Place, values: Mapping[str, float], rng: np.random.Generator) -> Case:
    slots = place.case.geometry.dimensions.slots
    theta = 2 * np.pi * np.arange(slots) / slots
    field = sum(
        rng.standard_normal() * np.cos(h * theta) + rng.standard_normal() * np.sin(h * theta)
        for h in HARMONICS
    )
    factors = np.asarray(field) * values["relative_sd"] / np.std(field)
    finding = Finding("outside_patchwork", place.true_stage.keys.name, dict(values))
    return place.case.with_broken(place.stage, Patchwork(factors)).with_finding(finding)


EFFECT = HiddenEffect("outside_patchwork", _parameters, _apply, is_free, in_library=False)
