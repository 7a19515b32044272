"""Outside the library: stiffness that winds around the stack, as of skewed welds."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from statorhom.conceal.breaks import Helix
from statorhom.conceal.hidden_effect import ANGLE, Drawn, HiddenEffect, Place, is_free
from statorhom.conceal.truth import Case, Finding


def _parameters(place: Place) -> tuple[Drawn, ...]:
    del place
    return (
        Drawn("relative_amplitude", 0.01, 0.25, "log", is_strength=True),
        ANGLE,
        Drawn("harmonic", 2.501, 6.499, "whole"),
        Drawn("twist_deg", 120.0, 360.0),
    )


def _apply(place: Place, values: Mapping[str, float], rng: np.random.Generator) -> Case:
    del rng
    helix = Helix(
        round(values["harmonic"]),
        values["relative_amplitude"],
        float(np.deg2rad(values["angle_deg"])),
        float(np.deg2rad(values["twist_deg"])),
    )
    finding = Finding(
        "outside_helix", place.true_stage.keys.name, dict(values), angle_deg=values["angle_deg"]
    )
    return place.case.with_broken(place.stage, helix).with_finding(finding)


EFFECT = HiddenEffect("outside_helix", _parameters, _apply, is_free, in_library=False)
