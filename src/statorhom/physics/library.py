"""The library of effects: every module of `statorhom.physics.effects` that has an `EFFECT`."""

from __future__ import annotations

import importlib
import pkgutil
from functools import cache

from statorhom.physics import effects
from statorhom.physics.candidate import Candidate
from statorhom.physics.effect import Effect
from statorhom.study.object_file import STATOR, TUBE
from statorhom.study.study import StudyFiles


@cache
def library() -> dict[str, Effect]:
    """All effects by name.

    Raises
    ------
    ValueError
        If two files claim the same name.
    """
    found: dict[str, Effect] = {}
    for module in sorted(pkgutil.iter_modules(effects.__path__), key=lambda m: m.name):
        effect = getattr(importlib.import_module(f"{effects.__name__}.{module.name}"), "EFFECT", None)
        if not isinstance(effect, Effect):
            continue
        if effect.name in found:
            raise ValueError(f"two effects are named {effect.name!r}")
        found[effect.name] = effect
    return found


def part_of(effect: str) -> str:
    """What of the machine or of the measurement an effect concerns; one that does not say is a part of its own."""
    known = library().get(effect)
    return effect if known is None or known.part is None else known.part


def all_candidates(files: StudyFiles) -> tuple[Candidate, ...]:
    """Everything that the library can say of a study."""
    found = [candidate for effect in library().values() for candidate in candidates_of(effect, files)]
    if files.drawing.kind not in (STATOR, TUBE):
        found += [candidate for effect in library().values() for candidate in effect.coupon_pairs(files)]
    return tuple(found)


def candidates_of(effect: Effect, files: StudyFiles) -> tuple[Candidate, ...]:
    """What an effect can be in a study, by the kind of body that the study is of; two of it are declared as two."""
    by_kind = {STATOR: effect.candidates, TUBE: effect.tube_candidates}
    return by_kind.get(files.drawing.kind, effect.coupon_candidates)(files)


def look_alike(one: Candidate, other: Candidate, files: StudyFiles) -> bool:
    """Whether the library says of either of two effects that it is confused with the other."""
    pairs = ((one.effect, other.effect), (other.effect, one.effect))
    return any(
        confusion.effect == taken_for
        for effect, taken_for in pairs
        for confusion in library()[effect].words(files).confused_with
    )
