"""The yoke's stiffness varies around the stator as one cosine, its mass unchanged."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from statorhom.conceal.breaks import Wave
from statorhom.conceal.hidden_effect import ANGLE, Drawn, HiddenEffect, Place, is_free
from statorhom.conceal.truth import Case, Finding

PERIODS = (2, 3)  # the harmonic is twice the order that splits


def _parameters(place: Place) -> tuple[Drawn, ...]:
    del place
    return (
        Drawn("half_harmonic", PERIODS[0] - 0.499, PERIODS[-1] + 0.499, "whole"),
        Drawn("relative_amplitude", 0.004, 0.08, "log", is_strength=True),
        ANGLE,
    )


def _apply(place: Place, values: Mapping[str, float], rng: np.random.Generator) -> Case:
    del rng
    harmonic = 2 * round(values["half_harmonic"])
    angle_deg = values["angle_deg"] % (360.0 / harmonic)
    inner = place.case.geometry.dimensions.slot_radius
    wave = Wave(harmonic, values["relative_amplitude"], float(np.deg2rad(angle_deg)), inner)
    parameters = {"harmonic": harmonic, "relative_amplitude": values["relative_amplitude"]}
    finding = Finding("ovality", place.true_stage.keys.name, parameters, angle_deg=angle_deg)
    return place.case.with_broken(place.stage, wave).with_finding(finding)


EFFECT = HiddenEffect("ovality", _parameters, _apply, is_free)
