"""Lines that are declared rigid are springs with losses."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from statorhom.conceal.hidden_effect import Drawn, HiddenEffect, Place
from statorhom.conceal.truth import Case, ElasticSupport, Finding
from statorhom.study.supports import LineSupport


def _parameters(place: Place) -> tuple[Drawn, ...]:
    del place
    return (
        Drawn("normal_stiffness_n_per_m2", 1e11, 3e8, "log", is_strength=True),
        Drawn("tangential_ratio", 0.3, 1.2),
    )


def _apply(place: Place, values: Mapping[str, float], rng: np.random.Generator) -> Case:
    declared = place.true_test.declared
    assert isinstance(declared, LineSupport), "the place has lines"
    lines = declared.model_copy(update={**values, "declared": "elastic"})
    loss = float(rng.uniform(0.01, 0.05))
    case = place.case
    for s, stage in enumerate(case.stages):
        for t, test in enumerate(stage.tests):
            if test.declared is not None and test.declared.name == declared.name:
                case = case.with_test(s, t, elastic=ElasticSupport(lines, loss))
    finding = Finding(
        "support_compliance",
        place.true_stage.keys.name,
        {**values, "loss_factor": loss},
        test=place.true_test.name,
    )
    return case.with_finding(finding)


def _fits(place: Place) -> bool:
    support = place.true_test.declared
    return isinstance(support, LineSupport) and support.declared == "rigid"


EFFECT = HiddenEffect("support_compliance", _parameters, _apply, _fits)
