"""What is to be concealed, as the command line says it."""

from __future__ import annotations

import math
from collections.abc import Sequence

from statorhom.conceal.conceal_study import Wish
from statorhom.errors import InputFileError
from statorhom.study.message import quoted


def wishes_from(
    effects: Sequence[str],
    settings: Sequence[str],
    strength: float | None,
    stage: str | None,
    test: str | None,
) -> tuple[Wish, ...]:
    """Wishes of `--effect A --effect B --set NAME=VALUE`; of several effects, NAME is EFFECT.NAME.

    Raises
    ------
    InputFileError
        If a setting is no number, or says not of which effect it is.
    """
    given: dict[str, dict[str, float]] = {name: {} for name in effects}
    for setting in settings:
        owner, name, value = _parsed(setting, effects)
        given[owner][name] = value
    return tuple(Wish(name, given[name], strength, stage, test) for name in effects)


def _parsed(setting: str, effects: Sequence[str]) -> tuple[str, str, float]:
    left, equals, right = setting.partition("=")
    owner, dot, name = left.strip().rpartition(".")
    if not dot and len(effects) == 1:
        owner = effects[0]
    if owner not in effects or not name:
        raise InputFileError(
            f"--set {quoted(setting)}: of which effect? write NAME=VALUE for one effect, EFFECT.NAME=VALUE for two"
        )
    try:
        value = float(right)
    except ValueError:
        value = math.nan
    if not equals or not math.isfinite(value):
        raise InputFileError(f"--set {quoted(setting)}: {quoted(right)} is no number; write NAME=VALUE")
    return owner, name, value
