"""The stator's dimensions in SI, checked against each other."""

from __future__ import annotations

import math
from dataclasses import dataclass

from statorhom.errors import GeometryError
from statorhom.geometry.frame import Frame, Shields, frame_of, shields_of
from statorhom.study.geometry_file import GeometryFile


@dataclass(frozen=True)
class StatorDimensions:
    """Dimensions of a stator (m).

    Parameters
    ----------
    slots : number of slots N (for a plain ring: of sectors).
    bore_radius, slot_radius, outer_radius : bore, slot bottom and back of the core; the yoke of a plain ring
        reaches down to its bore.
    length : of the core; it spans z = 0 … length.
    overhang : length of each winding overhang, or None.
    frame, shields : what the last steps add, or None.
    """

    slots: int
    bore_radius: float
    slot_radius: float
    outer_radius: float
    length: float
    overhang: float | None
    frame: Frame | None
    shields: Shields | None

    @property
    def half_pitch(self) -> float:
        """Half a slot pitch (rad)."""
        return math.pi / self.slots


def stator_dimensions(file: GeometryFile, where: str) -> StatorDimensions:
    """Convert a geometry file to SI and refuse what cannot be built.

    Raises
    ------
    GeometryError
        One line naming the file, the two keys that contradict each other and their values.
    """
    core = file.core
    bore, outer = core.bore_diameter_mm / 2e3, core.outer_diameter_mm / 2e3
    if bore >= outer:
        raise GeometryError(
            f"{where}: core.bore_diameter_mm = {core.bore_diameter_mm:g} must be smaller than "
            f"core.outer_diameter_mm = {core.outer_diameter_mm:g}"
        )
    return StatorDimensions(
        slots=file.slots.count,
        bore_radius=bore,
        slot_radius=bore if file.slots.shape == "none" else _slot_radius(file, where),
        outer_radius=outer,
        length=core.length_mm / 1e3,
        overhang=None if file.winding is None else file.winding.overhang_length_mm / 1e3,
        frame=frame_of(file, where),
        shields=shields_of(file, where),
    )


def _slot_radius(file: GeometryFile, where: str) -> float:
    core = file.core
    radial = (core.outer_diameter_mm - core.bore_diameter_mm) / 2
    if core.yoke_thickness_mm >= radial:
        raise GeometryError(
            f"{where}: core.yoke_thickness_mm = {core.yoke_thickness_mm:g} leaves no room for slots: "
            f"core.outer_diameter_mm and core.bore_diameter_mm are only {radial:g} mm apart in radius"
        )
    return core.outer_diameter_mm / 2e3 - core.yoke_thickness_mm / 1e3
