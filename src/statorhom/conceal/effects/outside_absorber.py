"""Outside the library: a loose part with a resonance of its own within the band."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from statorhom.conceal.hidden_effect import ANGLE, Drawn, HiddenEffect, Place, is_free
from statorhom.conceal.truth import Absorber, Case, Finding

HZ_OVER_ELLIPTIC = (0.95, 2.4)  # its resonance over the lowest mode of order 2, about


def _parameters(place: Place) -> tuple[Drawn, ...]:
    mass = place.true_stage.scale_kg
    return (
        Drawn("mass_kg", 0.002 * mass, 0.03 * mass, "log", is_strength=True),
        ANGLE,
        Drawn("z_share", 0.1, 0.9),
        Drawn("relative_frequency", *HZ_OVER_ELLIPTIC),
    )


def _apply(place: Place, values: Mapping[str, float], rng: np.random.Generator) -> Case:
    d = place.case.geometry.dimensions
    absorber = Absorber(
        float(np.deg2rad(values["angle_deg"])),
        values["z_share"] * d.length,
        values["mass_kg"],
        values["relative_frequency"],
        float(rng.uniform(0.02, 0.08)),
    )
    stage = place.true_stage
    parameters = {k: values[k] for k in ("mass_kg", "relative_frequency")}
    finding = Finding(
        "outside_absorber",
        stage.keys.name,
        parameters,
        angle_deg=values["angle_deg"],
        z_mm=1e3 * absorber.z,
    )
    case = place.case.with_stage(place.stage, absorbers=(*stage.absorbers, absorber))
    return case.with_finding(finding)


EFFECT = HiddenEffect("outside_absorber", _parameters, _apply, is_free, in_library=False)
