"""Open slots between parallel teeth with a fully rounded bottom, tangent to both tooth sides."""

from __future__ import annotations

import math

from statorhom.errors import GeometryError
from statorhom.geometry.dimensions import StatorDimensions
from statorhom.geometry.section import ORIGIN, Edge, Patch, Point, Section, polar
from statorhom.geometry.slots.open_slot import check_teeth_fit, tooth_side_angle


def round_bottom(d: StatorDimensions, tooth_width_mm: float, where: str) -> Section:
    """Section whose slot bottom is one arc through the deepest point on the slot's centre line.

    The half disc is split into three patches about a point inside it, so that no cell degenerates where the
    arc leaves the tooth side. The overhang follows the slot's bottom.
    """
    half = tooth_width_mm / 2e3
    check_teeth_fit(d, tooth_width_mm, where)
    # distance of the arc's centre from the axis: tangent to the side and through the slot bottom
    at = (d.slot_radius + half) / (1 + math.sin(d.half_pitch))
    radius = d.slot_radius - at
    # along the middle of the tooth: where the arc leaves its side, and where the side begins
    if at * math.cos(d.half_pitch) <= math.sqrt(d.bore_radius**2 - half**2):
        raise GeometryError(
            f"{where}: slots.tooth_width_mm = {tooth_width_mm:g} and core.yoke_thickness_mm leave a slot "
            f"that is wider than deep: its round bottom, {2e3 * radius:.4g} mm wide, begins below the bore; "
            f"use parallel_tooth"
        )
    return Section(_points(d, half, at, radius), _edges(polar(at, d.half_pitch)), PATCHES, OUTER)


OUTER = ("back.tooth", "back.corner", "back.slot")

PATCHES = (
    Patch("tooth", ("bore.tooth", "tangent.tooth", "tangent", "bore.side"), "lamination", True),
    Patch("slot side", ("bore.side", "tangent", "inner", "bore.inner"), "winding", True),
    Patch("slot centre", ("bore.inner", "inner", "centre", "bore.slot"), "winding", True),
    Patch("bottom core", ("inner", "hub", "axis", "centre"), "winding", True),
    Patch("bottom side", ("tangent", "corner", "hub", "inner"), "winding", True),
    Patch("bottom crown", ("hub", "corner", "bottom.slot", "axis"), "winding", True),
    Patch("tooth root", ("tangent.tooth", "corner.tooth", "corner", "tangent"), "lamination", True),
    Patch("yoke above the tooth", ("corner.tooth", "back.tooth", "back.corner", "corner"), "lamination"),
    Patch("yoke above the slot", ("corner", "back.corner", "back.slot", "bottom.slot"), "lamination"),
)


def _points(d: StatorDimensions, half: float, at: float, radius: float) -> dict[str, Point]:
    end = d.half_pitch
    cx, cy = centre = polar(at, end)
    tangent = _offset(centre, radius, -math.pi / 2)
    corner = _offset(centre, radius, (end - math.pi / 2) / 2)
    side = tooth_side_angle(half, d.bore_radius)
    r_tangent, r_corner = math.hypot(*tangent), math.hypot(*corner)
    a_corner = math.atan2(corner[1], corner[0])
    return {
        "bore.tooth": polar(d.bore_radius, 0.0),
        "bore.side": polar(d.bore_radius, side),
        "bore.inner": polar(d.bore_radius, (side + end) / 2),
        "bore.slot": polar(d.bore_radius, end),
        "tangent.tooth": (r_tangent, 0.0),
        "tangent": tangent,
        "inner": ((tangent[0] + cx) / 2, (tangent[1] + cy) / 2),
        "centre": centre,
        "axis": polar(at + radius / 2, end),
        "hub": _offset(centre, 0.6 * radius, (end - math.pi / 2) / 2),
        "corner.tooth": (r_corner, 0.0),
        "corner": corner,
        "bottom.slot": polar(d.slot_radius, end),
        "back.tooth": polar(d.outer_radius, 0.0),
        "back.corner": polar(d.outer_radius, a_corner),
        "back.slot": polar(d.outer_radius, end),
    }


def _offset(centre: Point, radius: float, angle: float) -> Point:
    return (centre[0] + radius * math.cos(angle), centre[1] + radius * math.sin(angle))


def _edges(centre: Point) -> tuple[Edge, ...]:
    return (
        Edge("bore.tooth", "bore.side", "tooth", ORIGIN, "end"),
        Edge("bore.side", "bore.inner", "shoulder", ORIGIN),
        Edge("bore.inner", "bore.slot", "round_crown", ORIGIN),
        Edge("tangent.tooth", "tangent", "tooth", ORIGIN, "end"),
        Edge("tangent", "inner", "shoulder"),
        Edge("inner", "centre", "round_crown"),
        *(Edge(f"bore.{a}", b, "radial", None, "end") for a, b in BODY),
        Edge("inner", "hub", "round_side"),
        Edge("centre", "axis", "round_side"),
        Edge("tangent", "corner", "round_side", centre),
        Edge("tangent.tooth", "corner.tooth", "round_side"),
        Edge("hub", "axis", "round_crown"),
        Edge("hub", "corner", "shoulder"),
        Edge("axis", "bottom.slot", "shoulder"),
        Edge("corner", "bottom.slot", "round_crown", centre),
        Edge("corner.tooth", "corner", "tooth", ORIGIN, "end"),
        Edge("back.tooth", "back.corner", "tooth", ORIGIN, "end"),
        Edge("back.corner", "back.slot", "round_crown", ORIGIN),
        Edge("corner.tooth", "back.tooth", "yoke", None, "start"),
        Edge("corner", "back.corner", "yoke", None, "start"),
        Edge("bottom.slot", "back.slot", "yoke", None, "start"),
    )


BODY = (("tooth", "tangent.tooth"), ("side", "tangent"), ("inner", "inner"), ("slot", "centre"))
