"""``[[stages.tests]]``: one modal test of a stage."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Field, field_validator, model_validator

from statorhom.study.keys import Keys, Name, Number, Positive, Title, WholeNumber

Point = tuple[Number, Number, Number]


def _listed(files: Any) -> Any:
    """One file may stand without brackets."""
    return [files] if isinstance(files, str) else files


class ModalTestKeys(Keys):
    """A modal test: its support and its data, either a modal table or recordings.

    ``role`` overrides which tests are fitted and which only predicted; ``hold_out`` names modes of the table
    (by the column ``mode``, else by the number of the row) that are predicted and not fitted.
    """

    name: Name
    support: Title
    modal_table: Title | None = None
    frf: Title | None = None
    hits: Annotated[tuple[Title, ...], Field(min_length=1), BeforeValidator(_listed)] | None = None
    force_level_n: Positive | None = None
    temperature_c: Annotated[Number, Field(gt=-273.15)] | None = None
    weighed: Annotated[bool, Field(strict=True)] = False
    sample_rate_hz: Positive | None = None
    hammer_mm: Point | None = None
    response_mm: Point | None = None
    direction: Annotated[str, Field(strict=True)] | None = None
    force_full_scale_n: Positive | None = None
    acceleration_full_scale_m_s2: Positive | None = None
    role: Literal["fit", "predict"] | None = None
    hold_out: tuple[WholeNumber, ...] = ()

    @field_validator("direction")
    @classmethod
    def _known_direction(cls, direction: str | None) -> str | None:
        names = ("r", "theta", "x", "y", "z")
        if direction is not None and direction not in [
            sign + name for sign in ("", "+", "-") for name in names
        ]:
            raise ValueError("is no direction; use r, theta, x, y or z, with a sign where it is reversed")
        return direction

    @model_validator(mode="after")
    def _one_source(self) -> ModalTestKeys:
        given = [key for key in ("modal_table", "frf", "hits") if getattr(self, key) is not None]
        if not given:
            raise ValueError("has no data; add one of modal_table, frf and hits")
        if len(given) > 1:
            raise ValueError(
                f"has {' and '.join(given)}; keep one of them and write another test for the rest"
            )
        return self

    @property
    def paths(self) -> tuple[str, ...]:
        """The files of this test as typed, relative to the study's folder."""
        single = self.modal_table if self.modal_table is not None else self.frf
        return (single,) if single is not None else self.hits or ()
