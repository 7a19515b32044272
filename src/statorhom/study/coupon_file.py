"""Geometry files of coupons: test pieces of a material, with one region named after their kind."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from statorhom.study.keys import Keys, Positive, Title


class PlateKeys(Keys):
    """``[plate]``: material axes 1 = x along the length, 2 = y along the width, 3 = z through the thickness."""

    length_mm: Positive
    width_mm: Positive
    thickness_mm: Positive


class BeamKeys(Keys):
    """``[beam]``: axes as a plate's; sheets are stacked along z."""

    length_mm: Positive
    width_mm: Positive
    height_mm: Positive
    stack_axis: Literal["z"] = "z"


class TubeKeys(Keys):
    """``[tube]``: material axes 1 = r, 2 = θ, 3 = z along the tube."""

    outer_diameter_mm: Positive
    inner_diameter_mm: Positive
    length_mm: Positive


class PlateFile(Keys):
    """A geometry file of ``kind = "plate"``."""

    schema_version: Literal[1] = Field(alias="schema")
    name: Title
    kind: Literal["plate"]
    plate: PlateKeys


class BeamFile(Keys):
    """A geometry file of ``kind = "beam"``."""

    schema_version: Literal[1] = Field(alias="schema")
    name: Title
    kind: Literal["beam"]
    beam: BeamKeys


class TubeFile(Keys):
    """A geometry file of ``kind = "tube"``."""

    schema_version: Literal[1] = Field(alias="schema")
    name: Title
    kind: Literal["tube"]
    tube: TubeKeys


CouponFile = PlateFile | BeamFile | TubeFile
