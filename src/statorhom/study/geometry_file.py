"""The geometry file of a stator: dimensions as its drawing gives them.

Only single keys are checked here. Whether the dimensions fit each other is the business of the geometry.
"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field, model_validator

from statorhom.study.keys import Keys, NotNegative, Number, Positive, Title, WholeNumber
from statorhom.study.toml_file import read_toml

_OTHER_KINDS = ("plate", "beam", "tube", "wing")

SlotCount = Annotated[WholeNumber, Field(ge=3, le=1000)]


class CoreKeys(Keys):
    """``[core]``: the laminated core, a ring from bore to outer surface; the slots end at the yoke."""

    outer_diameter_mm: Positive
    bore_diameter_mm: Positive
    length_mm: Positive
    yoke_thickness_mm: Positive


class ParallelToothSlots(Keys):
    """Open slots between teeth of constant width; the slot bottom lies at a constant radius."""

    shape: Literal["parallel_tooth"]
    count: SlotCount
    tooth_width_mm: Positive


class SemiClosedSlots(Keys):
    """Teeth of constant width with tips that leave an opening; a wedge joins tip and flank."""

    shape: Literal["semi_closed"]
    count: SlotCount
    tooth_width_mm: Positive
    opening_width_mm: Positive
    tip_height_mm: Positive
    wedge_height_mm: NotNegative = 0.0


class RoundBottomSlots(Keys):
    """Open slots between teeth of constant width; the bottom is a full round tangent to both flanks."""

    shape: Literal["round_bottom"]
    count: SlotCount
    tooth_width_mm: Positive


class ParallelSlots(Keys):
    """Open slots of constant width, as hairpins need them."""

    shape: Literal["parallel_slot"]
    count: SlotCount
    slot_width_mm: Positive


class NoSlots(Keys):
    """A plain ring; the count is only the number of equal sectors that the mesh is copied from."""

    shape: Literal["none"]
    count: SlotCount = 36


SlotKeys = ParallelToothSlots | SemiClosedSlots | RoundBottomSlots | ParallelSlots | NoSlots


class LaminationKeys(Keys):
    """``[lamination]``: what the analytic homogenization of the sheets needs."""

    sheet_thickness_mm: Positive
    coating_thickness_mm: Positive


class WindingKeys(Keys):
    """``[winding]``: overhang of each end (a ring from the bore to the slot bottom) and the wire."""

    overhang_length_mm: Positive
    wire_radius_mm: Positive | None = None
    insulated_radius_mm: Positive | None = None
    tape_mass_kg: NotNegative = 0.0


class FrameKeys(Keys):
    """``[frame]``: a sleeve around the core; ``offset_mm`` is the z of its lower end."""

    inner_diameter_mm: Positive
    outer_diameter_mm: Positive
    length_mm: Positive
    offset_mm: Number


class MachineKeys(Keys):
    """``[machine]``: two end shields, rings on the ends of the frame."""

    shield_thickness_mm: Positive
    shield_bore_diameter_mm: Positive


class GeometryFile(Keys):
    """A geometry file of ``kind = "stator"``."""

    schema_version: Literal[1] = Field(alias="schema")
    name: Title
    kind: Literal["stator"] = "stator"
    core: CoreKeys
    slots: Annotated[SlotKeys, Field(discriminator="shape")]
    lamination: LaminationKeys | None = None
    winding: WindingKeys | None = None
    frame: FrameKeys | None = None
    machine: MachineKeys | None = None

    @model_validator(mode="before")
    @classmethod
    def _no_coupon(cls, table: Any) -> Any:
        # told before the keys of such a file are all called unknown
        kind = table.get("kind") if isinstance(table, dict) else None
        if kind in _OTHER_KINDS:
            raise ValueError(f"a {kind} is no stator, and this works on stators only; {STATORS_ONLY}")
        return table


STATORS_ONLY = 'use simulate, fit, run or report, or a geometry of kind = "stator"'


def read_geometry(path: Path) -> GeometryFile:
    """Read a stator's geometry file.

    Parameters
    ----------
    path : Path
        The TOML file.

    Returns
    -------
    GeometryFile

    Raises
    ------
    InputFileError
        One line with file, key and remedy.
    """
    return read_toml(path, GeometryFile)
