"""``[[stages.effects]]``: physics that a stage's model is to contain beside materials and supports.

Which effects there are and what keys they take is the library's business (`statorhom.physics.declared`); here a table
of any of them is read and kept.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Annotated, Any

from pydantic import AfterValidator, PlainSerializer, model_validator

from statorhom.study.frozen_map import FrozenMap
from statorhom.study.keys import Keys, Title
from statorhom.study.message import quoted

Values = Annotated[
    Mapping[str, float | int | str], AfterValidator(FrozenMap), PlainSerializer(FrozenMap.plain)
]
OWN = ("effect", "region", "test")


class EffectKeys(Keys):
    """One effect: its name, where it is confined to one region or test, and its own keys with their values."""

    effect: Title
    region: Title | None = None
    test: Title | None = None
    values: Values = FrozenMap({})

    @model_validator(mode="before")
    @classmethod
    def _gathered(cls, table: Any) -> Any:
        """The effect's own keys stand beside the common ones."""
        if not isinstance(table, dict) or isinstance(table.get("values"), Mapping):
            return table
        own = {key: value for key, value in table.items() if key not in OWN}
        for key, value in own.items():
            number = isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)
            if not number and not isinstance(value, str):
                raise ValueError(f"{key} must be a number or text, but is {quoted(value)}; correct it")
        return {key: table[key] for key in OWN if key in table} | {"values": own}
