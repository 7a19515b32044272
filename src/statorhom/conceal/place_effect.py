"""Put an effect somewhere into a case, with given and drawn parameters."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from statorhom.conceal.hidden_effect import Drawn, HiddenEffect, Place
from statorhom.conceal.truth import Case
from statorhom.errors import InputFileError
from statorhom.study.nearest import hint


def with_effect(
    case: Case,
    effect: HiddenEffect,
    rng: np.random.Generator,
    *,
    given: Mapping[str, float] | None = None,
    strength: float | None = None,
    stage: str | None = None,
    test: str | None = None,
) -> Case:
    """The case with one effect more.

    Parameters
    ----------
    case, effect : what is true so far, and what is to be concealed.
    rng : draws what is not given.
    given : values of parameters.
    strength : 0 (hardly felt) to 1 for the parameters that are strengths; None: drawn.
    stage, test : where; None: the first place that the effect fits.

    Raises
    ------
    InputFileError
        If there is no such place or parameter.
    """
    place = _place(case, effect, stage, test)
    parameters = effect.parameters(place)
    values = _values(effect.name, parameters, dict(given or {}), strength, rng)
    found = effect.apply(place, values, rng)
    return replace(found, is_explicable=case.is_explicable and effect.in_library)


def places(case: Case, effect: HiddenEffect) -> list[Place]:
    """All places that an effect fits."""
    every = [Place(case, s, t) for s, stage in enumerate(case.stages) for t in range(len(stage.tests))]
    return [place for place in every if effect.fits(place)]


def _place(case: Case, effect: HiddenEffect, stage: str | None, test: str | None) -> Place:
    for place in places(case, effect):
        names = place.true_stage.keys.name, place.true_test.name
        if stage in (None, names[0]) and test in (None, names[1]):
            return place
    asked = "".join(f" in the {what} {name!r}" for what, name in (("stage", stage), ("test", test)) if name)
    raise InputFileError(
        f"--effect {effect.name}: nothing of this study can have it{asked}; take a study with the steps, supports "
        f"and kinds of tests that it needs"
    )


def _values(
    name: str,
    parameters: tuple[Drawn, ...],
    given: dict[str, float],
    strength: float | None,
    rng: np.random.Generator,
) -> dict[str, float]:
    known = [p.name for p in parameters]
    for key in given:
        if key not in known:
            choice = hint(key, known) if known else "it has none"
            raise InputFileError(f"--set {key}: {name} has no such parameter; {choice}")
    found = {}
    for parameter in parameters:
        # drawn even where it is given: one given value leaves the others as they were
        share = float(rng.random())
        if parameter.is_strength and strength is not None:
            share = strength
        found[parameter.name] = given.get(parameter.name, parameter.at(share))
    return found
