"""What all tables of the TOML files share: fixed keys, frozen, numbers that are numbers."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import AfterValidator, AllowInfNan, BaseModel, ConfigDict, Field, Strict, model_validator
from pydantic_core import PydanticCustomError

from statorhom.study.message import quoted
from statorhom.study.nearest import hint

# 60 characters of up to four bytes and an ending fit into the 255 bytes of a file's name
_LONGEST_NAME = 60


def _check_title(title: str) -> str:
    if not title.strip() or not title.isprintable():
        raise ValueError("must be printable text on one line; type one that is not empty")
    return title


def _check_name(name: str) -> str:
    _check_title(name)
    if len(name) > _LONGEST_NAME or name != name.strip() or name.startswith(".") or set(name) & set("/\\"):
        raise ValueError(
            f"{quoted(name)} cannot name results files; use at most {_LONGEST_NAME} characters "
            "without / and \\, beginning with neither a space nor a full stop"
        )
    return name


Number = Annotated[float, Strict(), AllowInfNan(False)]
Positive = Annotated[float, Strict(), AllowInfNan(False), Field(gt=0.0)]
NotNegative = Annotated[float, Strict(), AllowInfNan(False), Field(ge=0.0)]
WholeNumber = Annotated[int, Strict()]
Title = Annotated[str, AfterValidator(_check_title)]
Name = Annotated[str, AfterValidator(_check_name)]


class Keys(BaseModel):
    """A TOML table with a fixed set of keys; an unknown one is an error that names the nearest known key."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    @model_validator(mode="before")
    @classmethod
    def _no_unknown_keys(cls, table: Any) -> Any:
        if isinstance(table, dict):
            known = [field.alias or name for name, field in cls.model_fields.items()]
            for key in table:
                if key not in known:
                    raise PydanticCustomError(
                        "unknown_key", "{text}", {"text": f"unknown key {quoted(key)}; {hint(key, known)}"}
                    )
        return table
