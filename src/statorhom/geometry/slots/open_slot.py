"""Open slots: one tooth side from the bore to the slot bottom (parallel teeth or parallel slots)."""

from __future__ import annotations

import math

from statorhom.errors import GeometryError
from statorhom.geometry.dimensions import StatorDimensions
from statorhom.geometry.section import ORIGIN, Edge, Patch, Section, polar


def tooth_side_angle(half_width: float, radius: float) -> float:
    """Angle (rad) at which the side of a parallel tooth crosses `radius`."""
    return math.asin(half_width / radius)


def parallel_tooth(d: StatorDimensions, tooth_width_mm: float, where: str) -> Section:
    """Open slots between teeth of constant width, slot bottom at a constant radius."""
    half = tooth_width_mm / 2e3
    check_teeth_fit(d, tooth_width_mm, where)
    return open_slot(d, tooth_side_angle(half, d.bore_radius), tooth_side_angle(half, d.slot_radius))


def parallel_slot(d: StatorDimensions, slot_width_mm: float, where: str) -> Section:
    """Open slots of constant width (hairpin windings), slot bottom at a constant radius."""
    half = slot_width_mm / 2e3
    _check_width(d, "slot", "slots", slot_width_mm, where)
    at_bore = d.half_pitch - math.asin(half / d.bore_radius)
    return open_slot(d, at_bore, d.half_pitch - math.asin(half / d.slot_radius))


def check_teeth_fit(d: StatorDimensions, tooth_width_mm: float, where: str) -> None:
    """Refuse teeth that overlap at the bore.

    Raises
    ------
    GeometryError
        Naming tooth_width_mm and count.
    """
    _check_width(d, "tooth", "teeth", tooth_width_mm, where)


def _check_width(d: StatorDimensions, what: str, plural: str, width_mm: float, where: str) -> None:
    room_mm = 2e3 * d.bore_radius * math.sin(d.half_pitch)
    if width_mm >= room_mm:
        raise GeometryError(
            f"{where}: slots.{what}_width_mm = {width_mm:g} and slots.count = {d.slots}: the {plural} "
            f"overlap at the bore, where there is room for {room_mm:.4g} mm"
        )


def open_slot(d: StatorDimensions, side_at_bore: float, side_at_bottom: float) -> Section:
    """Section of an open slot whose side is a straight line between the two given angles (rad)."""
    end = d.half_pitch
    points = {
        "bore.tooth": polar(d.bore_radius, 0.0),
        "bore.side": polar(d.bore_radius, side_at_bore),
        "bore.slot": polar(d.bore_radius, end),
        "bottom.tooth": polar(d.slot_radius, 0.0),
        "bottom.side": polar(d.slot_radius, side_at_bottom),
        "bottom.slot": polar(d.slot_radius, end),
        "back.tooth": polar(d.outer_radius, 0.0),
        "back.side": polar(d.outer_radius, side_at_bottom),
        "back.slot": polar(d.outer_radius, end),
    }
    edges = []
    for level in ("bore", "bottom", "back"):
        edges.append(Edge(f"{level}.tooth", f"{level}.side", "tooth", ORIGIN, "end"))
        edges.append(Edge(f"{level}.side", f"{level}.slot", "slot", ORIGIN, "start"))
    for column in ("tooth", "side", "slot"):
        edges.append(Edge(f"bore.{column}", f"bottom.{column}", "radial", None, "end"))
        edges.append(Edge(f"bottom.{column}", f"back.{column}", "yoke", None, "start"))
    patches = (
        Patch("tooth", ("bore.tooth", "bottom.tooth", "bottom.side", "bore.side"), "lamination", True),
        Patch("slot", ("bore.side", "bottom.side", "bottom.slot", "bore.slot"), "winding", True),
        Patch(
            "yoke above the tooth", ("bottom.tooth", "back.tooth", "back.side", "bottom.side"), "lamination"
        ),
        Patch("yoke above the slot", ("bottom.side", "back.side", "back.slot", "bottom.slot"), "lamination"),
    )
    return Section(points, tuple(edges), patches, ("back.tooth", "back.side", "back.slot"))
