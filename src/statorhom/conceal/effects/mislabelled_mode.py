"""One mode of a table carries the name of another."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from statorhom.conceal.hidden_effect import Drawn, HiddenEffect, Place
from statorhom.conceal.truth import Case, Finding


def _parameters(place: Place) -> tuple[Drawn, ...]:
    del place
    return ()


def _apply(place: Place, values: Mapping[str, float], rng: np.random.Generator) -> Case:
    del values
    case = place.case.with_test(place.stage, place.test, relabelled=int(rng.integers(2**31)))
    # which mode it is and what it should be called is known when the table is written
    finding = Finding("mislabelled_mode", place.true_stage.keys.name, {}, test=place.true_test.name)
    return case.with_finding(finding)


def _fits(place: Place) -> bool:
    return place.true_test.is_table and place.true_test.declared is None


EFFECT = HiddenEffect("mislabelled_mode", _parameters, _apply, _fits)
