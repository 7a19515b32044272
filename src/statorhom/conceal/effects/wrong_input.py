"""A mass is typed wrongly: two digits exchanged, or one misread."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from statorhom.conceal.hidden_effect import Drawn, HiddenEffect, Place
from statorhom.conceal.truth import Case, Finding


def _parameters(place: Place) -> tuple[Drawn, ...]:
    del place
    return (Drawn("error", 0.01, 0.2, "log", is_strength=True),)


def _apply(place: Place, values: Mapping[str, float], rng: np.random.Generator) -> Case:
    del rng
    index = place.stage
    right = place.case.study["stages"][index]["mass_kg"]
    typed = misread(right, values["error"], place)
    finding = Finding(
        "wrong_input",
        place.true_stage.keys.name,
        {"input": "mass_kg", "value": right, "in_file": typed},
    )
    return place.case.with_stage_keys(index, mass_kg=typed).with_finding(finding)


def misread(right: float, error: float, place: Place) -> float:
    """The number with two digits exchanged, or one replaced, that is off by about `error` and can be a mass here."""
    masses = [stage["mass_kg"] for stage in place.case.study["stages"]]
    below = masses[place.stage - 1] if place.stage else 0.0
    above = masses[place.stage + 1] if place.stage + 1 < len(masses) else np.inf
    digits = [int(c) for c in f"{round(right * 1e3):d}"]
    found = []
    for i in range(len(digits)):
        for j in range(i + 1, len(digits)):
            other = digits.copy()
            other[i], other[j] = other[j], other[i]
            found.append(other)
        found += [[*digits[:i], d, *digits[i + 1 :]] for d in range(10)]
    numbers = {int("".join(map(str, other))) / 1e3 for other in found} - {round(right, 3)}
    possible = sorted(n for n in numbers if below < n < above)
    return min(possible, key=lambda n: abs(np.log(abs(n / right - 1) / error)))


def _fits(place: Place) -> bool:
    return place.test == 0


EFFECT = HiddenEffect("wrong_input", _parameters, _apply, _fits)
