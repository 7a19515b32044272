"""Effects that a study declares itself (``[[stages.effects]]``): read with the library, and written for it.

A table's own keys are the effect's parameters and choices by their names; a place stands in the units that users type:
`angle_rad` as `angle_deg`, `z_m` as `z_mm`. The first parameter and the place are needed; others have their usual value
where they are left out.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields

import numpy as np

from statorhom.physics.action import Action
from statorhom.physics.candidate import Candidate
from statorhom.physics.effect import Effect
from statorhom.physics.library import candidates_of, library
from statorhom.physics.parameter import EffectParameter
from statorhom.study.declared_effects import EffectKeys
from statorhom.study.message import input_error, quoted
from statorhom.study.nearest import hint
from statorhom.study.study import StudyFiles

# what the study's other keys say already
OWN_KEYS = {
    "masses": "correct mass_kg",
    "dimensions": "correct the geometry file",
    "symmetries": "declare the symmetry in [stages.model]",
    "supports": 'write declared = "elastic" and the stiffness in [[supports]]',
    "names": "correct order and axial in the modal table",
}
UNITS = {"_rad": ("_deg", float(np.pi / 180)), "_m": ("_mm", 1e-3)}  # typed unit, and its size


@dataclass(frozen=True, eq=False)
class DeclaredEffect:
    """An effect with its parameters as a study gives them.

    Parameters
    ----------
    candidate : effect and place.
    values : of its parameters, in their own units.
    action : what it does.
    """

    candidate: Candidate
    values: Mapping[str, float]
    action: Action


def declared_effects(files: StudyFiles) -> tuple[DeclaredEffect, ...]:
    """All effects that a study declares.

    Raises
    ------
    InputFileError
        If an effect, a place or a key is unknown, missing or impossible.
    """
    return tuple(
        _declared(files, stage.name, number, keys)
        for stage in files.study.stages
        for number, keys in enumerate(stage.effects, start=1)
    )


def effect_table(candidate: Candidate, values: Mapping[str, float]) -> dict[str, float | int | str]:
    """The table that declares an effect in a study file."""
    table: dict[str, float | int | str] = {"effect": candidate.effect}
    for key, place in (("region", candidate.region), ("test", candidate.test)):
        if place is not None:
            table[key] = place
    table |= dict(candidate.choice)
    for p in candidate.parameters:
        if p.name in values or p.usual is None:
            key, unit = _typed(p.name)
            table[key] = values[p.name] / unit
    return table


def says_itself(action: Action) -> str | None:
    """How a study says without an effect what an action does; None where it cannot."""
    return next((how for name, how in OWN_KEYS.items() if getattr(action, name)), None)


def beyond(action: Action, understood: Sequence[str]) -> str | None:
    """What an action does beside the kinds of change that are understood; None where that is all."""
    plain = Action()
    for part in fields(action):
        known = part.name in (*understood, "stages", "tests")
        if not known and getattr(action, part.name) != getattr(plain, part.name):
            return part.name
    return None


def _typed(name: str) -> tuple[str, float]:
    """Key of a parameter in a study file, and what one of its unit is in the parameter's own."""
    for ending, (typed, unit) in UNITS.items():
        if name.endswith(ending) and "_per_" not in name:
            return name.removesuffix(ending) + typed, unit
    return name, 1.0


def _declared(files: StudyFiles, stage: str, number: int, keys: EffectKeys) -> DeclaredEffect:
    where = f"stages[{stage}].effects[#{number}]"
    effect = library().get(keys.effect)
    if effect is None:
        raise input_error(
            files.path, f"{where}.effect", f"no effect {quoted(keys.effect)}", hint(keys.effect, library())
        )
    candidate = _candidate(files, stage, where, effect, keys)
    first = candidate.parameters[:1]
    values = {
        p.name: _value(files, where, keys, p, needed=p.located or p in first) for p in candidate.parameters
    }
    action = effect.action(candidate, values, files)
    instead = says_itself(action)
    if instead is not None:
        raise input_error(files.path, where, f"{effect.name} is no entry of effects", f"{instead} instead")
    return DeclaredEffect(candidate, values, action)


def _candidate(files: StudyFiles, stage: str, where: str, effect: Effect, keys: EffectKeys) -> Candidate:
    """The library's candidate that a table means."""
    possible = [c for c in candidates_of(effect, files) if c.stage == stage]
    if not possible:
        others = sorted({c.stage for c in candidates_of(effect, files)})
        remedy = f"it can be in {', '.join(others)}" if others else "delete it"
        raise input_error(files.path, where, f"{effect.name} cannot be in stage {quoted(stage)}", remedy)
    choices = list(dict.fromkeys(name for c in possible for name, _ in c.choice))
    known = [*dict.fromkeys(_typed(p.name)[0] for c in possible for p in c.parameters), *choices]
    for key in keys.values:
        if key not in known:
            names = ["effect", "region", "test", *known]
            raise input_error(files.path, where, f"unknown key {quoted(key)}", hint(key, names))
    for key in (*choices, "region", "test"):
        possible = _narrowed(files, where, possible, keys, key)
    return possible[0]


def _narrowed(
    files: StudyFiles, where: str, possible: Sequence[Candidate], keys: EffectKeys, key: str
) -> list[Candidate]:
    """Candidates that agree with a key of the table; one that is left open must be the same for all."""

    def said(candidate: Candidate) -> object:
        return getattr(candidate, key) if key in ("region", "test") else candidate.chosen.get(key)

    given = getattr(keys, key) if key in ("region", "test") else keys.values.get(key)
    options = list(dict.fromkeys(said(c) for c in possible))
    if given is None and len(options) == 1:
        return list(possible)
    named = ", ".join(quoted(o) for o in options if o is not None)
    if given is None:
        raise input_error(files.path, f"{where}.{key}", "is missing", f"add it: one of {named}")
    if given not in options:
        raise input_error(files.path, f"{where}.{key}", f"cannot be {quoted(given)}", f"use one of {named}")
    return [c for c in possible if said(c) == given]


def _value(
    files: StudyFiles, where: str, keys: EffectKeys, parameter: EffectParameter, *, needed: bool
) -> float:
    """What a table gives a parameter; one that is not needed has its usual value."""
    key, unit = _typed(parameter.name)
    given = keys.values.get(key, None if parameter.usual is None else parameter.usual / unit)
    if given is None and parameter.starts and not needed:
        return parameter.starts[0]
    if given is None:
        raise input_error(files.path, f"{where}.{key}", "is missing", "add this key")
    if isinstance(given, str):
        raise input_error(
            files.path,
            f"{where}.{key}",
            f"must be a number, but is {quoted(given)}",
            "type it without quotes",
        )
    low, high = parameter.lower, parameter.upper
    if parameter.scale != "angle" and not low <= given * unit <= high:
        limits = f"{low / unit:.4g} … {high / unit:.4g}"
        raise input_error(
            files.path, f"{where}.{key}", f"{given:g} is not possible", f"use a number of {limits}"
        )
    if parameter.scale == "angle":
        return low + (given * unit - low) % (high - low)
    return given * unit
