"""Outside the library: four unlike lumps around the stator."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from statorhom.conceal.breaks import Lump
from statorhom.conceal.hidden_effect import Drawn, HiddenEffect, Place, is_free
from statorhom.conceal.truth import Case, Finding

COUNT = 4
FOOT, HEIGHT = 0.010, 0.006  # m


def _parameters(place: Place) -> tuple[Drawn, ...]:
    mass = place.true_stage.scale_kg
    return (Drawn("mass_kg", 0.01 * mass, 0.10 * mass, "log", is_strength=True),)


def _apply(place: Place, values: Mapping[str, float], rng: np.random.Generator) -> Case:
    stage, length = place.true_stage, place.case.geometry.dimensions.length
    shares = rng.dirichlet(np.full(COUNT, 4.0))
    lumps = tuple(
        Lump(
            float(rng.uniform(0, 2 * np.pi)),
            float(rng.uniform(0.15, 0.85)) * length,
            share * values["mass_kg"],
            FOOT,
            HEIGHT,
        )
        for share in shares
    )
    parameters = {"mass_kg": [lump.mass_kg for lump in lumps], "note": "at several places"}
    case = place.case.with_stage(place.stage, breaks=(*stage.breaks, *lumps))
    return case.with_finding(Finding("outside_lumps", stage.keys.name, parameters))


EFFECT = HiddenEffect("outside_lumps", _parameters, _apply, is_free, in_library=False)
