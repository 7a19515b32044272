"""Frame and core are joined by a finite contact stiffness."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from statorhom.conceal.hidden_effect import Drawn, HiddenEffect, Place, is_free
from statorhom.conceal.truth import Case, ContactLaw, Finding


def _parameters(place: Place) -> tuple[Drawn, ...]:
    del place
    return (
        Drawn("contact_stiffness_n_per_m3", 1e14, 3e11, "log", is_strength=True),
        Drawn("tangential_share", 0.3, 0.8),
    )


def _apply(place: Place, values: Mapping[str, float], rng: np.random.Generator) -> Case:
    del rng
    normal = values["contact_stiffness_n_per_m3"]
    law = ContactLaw(("frame",), normal, values["tangential_share"] * normal)
    parameters = {"contact_stiffness_n_per_m3": normal, "tangential_share": values["tangential_share"]}
    name = place.true_stage.keys.name
    return place.case.with_stage(place.stage, contact=law).with_finding(
        Finding("press_fit_contact", name, parameters)
    )


def _fits(place: Place) -> bool:
    return is_free(place) and place.true_stage.keys.kind == "framed"


EFFECT = HiddenEffect("press_fit_contact", _parameters, _apply, _fits)
