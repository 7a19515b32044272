"""``[[supports]]``: where a tested stator is held."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, model_validator

from statorhom.study.keys import Keys, Name, NotNegative, Number, Positive

Face = Literal["lower_end", "upper_end"]
Arc = tuple[Number, Number]

_FULL_CIRCLE = 360.0


class LineSupport(Keys):
    """Axial lines on the outer surface, over the whole core.

    ``normal_stiffness_n_per_m2`` is the stiffness of one line per metre of its length; ``tangential_ratio``
    the stiffness along the surface over the normal one.
    """

    name: Name
    kind: Literal["lines"]
    angles_deg: Annotated[tuple[Number, ...], Field(min_length=1)]
    declared: Literal["rigid", "elastic"]
    normal_stiffness_n_per_m2: Positive | None = None
    tangential_ratio: NotNegative = 1.0

    @model_validator(mode="after")
    def _consistent(self) -> LineSupport:
        _refuse_stiffness_of_rigid(self, "normal_stiffness_n_per_m2", self.normal_stiffness_n_per_m2)
        if len({angle % _FULL_CIRCLE for angle in self.angles_deg}) < len(self.angles_deg):
            raise ValueError("angles_deg names the same line twice; delete one of the angles")
        return self


class FaceSupport(Keys):
    """Whole end faces of the core, arcs of its outer surface over the whole length, or both.

    ``normal_stiffness_n_per_m3`` is the stiffness per square metre of the faces.
    """

    name: Name
    kind: Literal["faces"]
    faces: tuple[Face, ...] = ()
    arcs_deg: tuple[Arc, ...] = ()
    declared: Literal["rigid", "elastic"]
    normal_stiffness_n_per_m3: Positive | None = None
    tangential_ratio: NotNegative = 1.0

    @model_validator(mode="after")
    def _consistent(self) -> FaceSupport:
        _refuse_stiffness_of_rigid(self, "normal_stiffness_n_per_m3", self.normal_stiffness_n_per_m3)
        if not self.faces and not self.arcs_deg:
            raise ValueError('holds nothing; add faces = ["lower_end"] or arcs_deg = [[from, to]]')
        if len(set(self.faces)) < len(self.faces):
            raise ValueError("faces names the same end twice; delete one of them")
        for start, end in self.arcs_deg:
            if not 0.0 < end - start <= _FULL_CIRCLE:
                raise ValueError(
                    f"arcs_deg has [{start:g}, {end:g}]; an arc runs upwards by at most 360 degrees"
                )
        return self


SupportKeys = LineSupport | FaceSupport


def _refuse_stiffness_of_rigid(support: SupportKeys, key: str, stiffness: float | None) -> None:
    if support.name == "free":
        raise ValueError('"free" always exists; delete this support or give it another name')
    given = stiffness is not None or "tangential_ratio" in support.model_fields_set
    if support.declared == "rigid" and given:
        raise ValueError(f'a rigid support has no stiffness; delete {key} or write declared = "elastic"')
