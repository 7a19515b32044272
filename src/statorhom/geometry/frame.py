"""The frame pressed on the core and the end shields on its ends, checked against the core."""

from __future__ import annotations

from dataclasses import dataclass

from statorhom.errors import GeometryError
from statorhom.study.geometry_file import GeometryFile

# A press fit's interference is a per mille of the diameter; beyond this the diameters contradict each other.
LARGEST_INTERFERENCE = 3e-3
FLUSH_MM = 1e-3  # a frame that ends this close to the core's end is meant to be flush with it


@dataclass(frozen=True)
class Frame:
    """Sleeve pressed on the core; radii and lengths in metres, z from the core's lower end."""

    outer_radius: float
    z_low: float
    z_high: float


@dataclass(frozen=True)
class Shields:
    """Two end shields on the frame's ends; metres."""

    thickness: float
    bore_radius: float


def frame_of(file: GeometryFile, where: str) -> Frame | None:
    """The frame of a geometry file in SI.

    Raises
    ------
    GeometryError
        If it does not fit the core.
    """
    frame, core = file.frame, file.core
    if frame is None:
        return None
    inner, back = frame.inner_diameter_mm, core.outer_diameter_mm
    if abs(inner - back) > LARGEST_INTERFERENCE * back:
        relation = "smaller" if inner < back else "larger"
        raise GeometryError(
            f"{where}: frame.inner_diameter_mm = {inner:g} is {relation} than core.outer_diameter_mm = "
            f"{back:g} by more than a press fit ({LARGEST_INTERFERENCE:.1%}); make them equal"
        )
    if frame.outer_diameter_mm <= max(inner, back):
        raise GeometryError(
            f"{where}: frame.outer_diameter_mm = {frame.outer_diameter_mm:g} must be larger than "
            f"frame.inner_diameter_mm = {inner:g} and core.outer_diameter_mm = {back:g}"
        )
    low, high = (_flush(z, core.length_mm) for z in _ends(file))
    if high <= 0 or low >= core.length_mm:
        raise GeometryError(
            f"{where}: frame.offset_mm = {frame.offset_mm:g} and frame.length_mm = {frame.length_mm:g} put "
            f"the frame beside the core (z = 0 … core.length_mm = {core.length_mm:g})"
        )
    return Frame(frame.outer_diameter_mm / 2e3, low / 1e3, high / 1e3)


def shields_of(file: GeometryFile, where: str) -> Shields | None:
    """The end shields of a geometry file in SI.

    Raises
    ------
    GeometryError
        If they meet the core or the winding, or there is no frame to carry them.
    """
    machine, core = file.machine, file.core
    if machine is None:
        return None
    if file.frame is None:
        raise GeometryError(f"{where}: [machine] needs a [frame] whose ends the shields close; add it")
    if machine.shield_bore_diameter_mm >= core.outer_diameter_mm:
        raise GeometryError(
            f"{where}: machine.shield_bore_diameter_mm = {machine.shield_bore_diameter_mm:g} must be smaller "
            f"than core.outer_diameter_mm = {core.outer_diameter_mm:g}"
        )
    _check_room(file, where)
    return Shields(machine.shield_thickness_mm / 1e3, machine.shield_bore_diameter_mm / 2e3)


def _check_room(file: GeometryFile, where: str) -> None:
    """Refuse shields that reach the core, or the overhang where they do not pass outside of it."""
    assert file.frame is not None and file.machine is not None
    frame, core, winding = file.frame, file.core, file.winding
    low, high = _ends(file)
    room, end = min((-low, "lower"), (high - core.length_mm, "upper"))
    inside, key, value = 0.0, "core.length_mm", core.length_mm
    slot_diameter = core.outer_diameter_mm - 2 * core.yoke_thickness_mm
    if winding is not None and file.machine.shield_bore_diameter_mm < slot_diameter:
        inside = value = winding.overhang_length_mm
        key = "winding.overhang_length_mm"
    if room <= inside + FLUSH_MM:
        raise GeometryError(
            f"{where}: the {end} end shield meets {key} = {value:g}: the frame's frame.length_mm = "
            f"{frame.length_mm:g} with frame.offset_mm = {frame.offset_mm:g} ends {room:g} mm beyond the "
            f"core; lengthen the frame"
        )


def _ends(file: GeometryFile) -> tuple[float, float]:
    assert file.frame is not None
    return file.frame.offset_mm, file.frame.offset_mm + file.frame.length_mm


def _flush(z: float, length: float) -> float:
    return next((end for end in (0.0, length) if abs(z - end) < FLUSH_MM), z)
