"""No slots: a plain ring, for coupons cut from a core and for checks against exact solutions."""

from __future__ import annotations

from statorhom.geometry.dimensions import StatorDimensions
from statorhom.geometry.section import ORIGIN, Edge, Patch, Section, polar


def plain_ring(d: StatorDimensions) -> Section:
    """Section of a ring between bore and back."""
    points = {
        "bore.tooth": polar(d.bore_radius, 0.0),
        "bore.slot": polar(d.bore_radius, d.half_pitch),
        "back.tooth": polar(d.outer_radius, 0.0),
        "back.slot": polar(d.outer_radius, d.half_pitch),
    }
    edges = (
        Edge("bore.tooth", "bore.slot", "slot", ORIGIN),
        Edge("back.tooth", "back.slot", "slot", ORIGIN),
        Edge("bore.tooth", "back.tooth", "yoke"),
        Edge("bore.slot", "back.slot", "yoke"),
    )
    ring = Patch("ring", ("bore.tooth", "back.tooth", "back.slot", "bore.slot"), "lamination")
    return Section(points, edges, (ring,), ("back.tooth", "back.slot"))
