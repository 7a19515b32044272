"""All that can be concealed: every module of `statorhom.conceal.effects` that has an `EFFECT`."""

from __future__ import annotations

import importlib
import pkgutil
from functools import cache

from statorhom.conceal import effects
from statorhom.conceal.hidden_effect import HiddenEffect
from statorhom.errors import InputFileError
from statorhom.study.nearest import hint

NONE = "none"


@cache
def library() -> dict[str, HiddenEffect]:
    """All effects by name."""
    names = sorted(module.name for module in pkgutil.iter_modules(effects.__path__))
    found = [importlib.import_module(f"{effects.__name__}.{name}").EFFECT for name in names]
    return {effect.name: effect for effect in found}


def hidden_effect(name: str) -> HiddenEffect | None:
    """The effect of a name; None for "none".

    Raises
    ------
    InputFileError
        If there is no such effect.
    """
    if name == NONE:
        return None
    if name not in library():
        raise InputFileError(f"--effect {name}: there is no such effect; {hint(name, [NONE, *library()])}")
    return library()[name]
