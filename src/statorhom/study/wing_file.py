"""Geometry files of wings: plan form, skins as a table of plies, what stands between them, and what they carry."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Literal

from pydantic import AfterValidator, Field, PlainSerializer, StringConstraints, model_validator

from statorhom.study.frozen_map import FrozenMap
from statorhom.study.keys import Keys, NotNegative, Number, Positive, Title
from statorhom.study.message import quoted
from statorhom.study.nearest import hint

#: The region of what lumps bring: mass without stiffness.
LUMPS = "lumps"

_DIGITS_AND_LETTERS = r"^[A-Za-z][A-Za-z0-9_]*$"


def _no_reserved_name(name: str) -> str:
    if name == LUMPS:
        raise ValueError(f"{quoted(name)} is what [[wing.lumps]] are called; give the material another name")
    return name


MaterialName = Annotated[
    str, StringConstraints(pattern=_DIGITS_AND_LETTERS, max_length=40), AfterValidator(_no_reserved_name)
]
Percent = Annotated[Number, Field(gt=0.0, lt=100.0)]
RightAngle = Annotated[Number, Field(ge=-90.0, le=90.0)]


class PlyKeys(Keys):
    """``[[wing.plies]]``: a ply of both skins, listed from the mould inwards.

    ``angle_deg`` turns the material's axis 1 from the span towards the trailing edge. A core is a ply as well.
    """

    material: MaterialName
    thickness_mm: Positive
    angle_deg: RightAngle = 0.0


class CageKeys(Keys):
    """``[wing.cage]``: the box between the spars in the middle, free inside for the payload."""

    width_mm: Positive
    wall_thickness_mm: Positive
    material: MaterialName


class LumpKeys(Keys):
    """``[[wing.lumps]]``: a fin, a servo, a battery: mass on the upper skin, one each side unless ``y_mm`` is 0."""

    name: Title
    mass_g: Positive
    x_mm: Number
    y_mm: NotNegative


Densities = Annotated[
    Mapping[MaterialName, Positive], AfterValidator(FrozenMap), PlainSerializer(FrozenMap.plain)
]


class WingKeys(Keys):
    """``[wing]``: symmetric about its middle; x backwards from the nose, y to the right, z up.

    ``spars_percent`` and ``heights_percent`` are parts of the chord; the heights are those of the section at the
    leading edge, the front spar, the rear spar and the trailing edge.
    """

    span_mm: Positive
    root_chord_mm: Positive
    tip_chord_mm: Positive
    sweep_deg: Number = 0.0
    spars_percent: tuple[Percent, Percent]
    heights_percent: tuple[Positive, Positive, Positive, Positive]
    ribs_mm: tuple[Positive, ...] = ()
    web_thickness_mm: Positive
    web_material: MaterialName
    plies: Annotated[tuple[PlyKeys, ...], Field(min_length=1)]
    cage: CageKeys | None = None
    lumps: tuple[LumpKeys, ...] = ()
    density_kg_m3: Densities = FrozenMap({})

    @property
    def materials(self) -> tuple[str, ...]:
        """Names of all materials, the skin's first."""
        names = [*(ply.material for ply in self.plies), self.web_material]
        return tuple(dict.fromkeys(names if self.cage is None else [*names, self.cage.material]))

    @model_validator(mode="after")
    def _weight_gives_one_density(self) -> WingKeys:
        for name in self.density_kg_m3:
            if name not in self.materials:
                raise ValueError(
                    f"density_kg_m3.{name}: nothing is made of {quoted(name)}; {hint(name, self.materials)}"
                )
        missing = [name for name in self.materials if name not in self.density_kg_m3]
        if len(missing) > 1:
            raise ValueError(
                f"density_kg_m3: the weight gives one density, but those of {', '.join(missing)} are missing; "
                "add all but one"
            )
        return self


class WingFile(Keys):
    """A geometry file of ``kind = "wing"``."""

    schema_version: Literal[1] = Field(alias="schema")
    name: Title
    kind: Literal["wing"]
    wing: WingKeys
