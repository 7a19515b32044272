"""Semi-closed slots: parallel teeth with tips that leave an opening at the bore."""

from __future__ import annotations

import math

from statorhom.errors import GeometryError
from statorhom.geometry.dimensions import StatorDimensions
from statorhom.geometry.section import ORIGIN, Edge, Patch, Point, Section, polar
from statorhom.geometry.slots.open_slot import check_teeth_fit, tooth_side_angle
from statorhom.study.geometry_file import SemiClosedSlots

COLUMNS = ("tooth", "side", "edge", "slot")
DIVISIONS = ("tooth", "shoulder", "opening")


def semi_closed(d: StatorDimensions, keys: SemiClosedSlots, where: str) -> Section:
    """Section with tooth tips: the opening between them stays empty, the winding fills the slot behind it."""
    half = keys.tooth_width_mm / 2e3
    check_teeth_fit(d, keys.tooth_width_mm, where)
    low = d.bore_radius + keys.tip_height_mm / 1e3
    high = low + keys.wedge_height_mm / 1e3
    _check(d, keys, half, high, where)
    end, opening = d.half_pitch, keys.opening_width_mm / 2e3
    edge_bore, edge_low = (end - math.asin(opening / r) for r in (d.bore_radius, low))
    side_high, side_bottom = tooth_side_angle(half, high), tooth_side_angle(half, d.slot_radius)
    # the column of the opening goes on to the slot bottom at the same share of the slot's width
    share = (edge_low - side_high) / (end - side_high)
    edge_bottom = side_bottom + share * (end - side_bottom)
    angles = {
        "bore": (0.0, tooth_side_angle(half, d.bore_radius), edge_bore, end),
        "tip": (0.0, side_high, edge_low, end),
        "bottom": (0.0, side_bottom, edge_bottom, end),
        "back": (0.0, side_bottom, edge_bottom, end),
    }
    radii = {
        "bore": (d.bore_radius,) * 4,
        "tip": (high, high, low, low),
        "bottom": (d.slot_radius,) * 4,
        "back": (d.outer_radius,) * 4,
    }
    points = {
        f"{level}.{column}": polar(radii[level][i], angles[level][i])
        for level in angles
        for i, column in enumerate(COLUMNS)
    }
    _check_tip(d, keys, (points["tip.side"], points["tip.edge"]), where)
    return Section(points, _edges(sloped=high > low), _patches(), tuple(f"back.{c}" for c in COLUMNS))


def _edges(sloped: bool) -> tuple[Edge, ...]:
    edges = []
    for level in ("bore", "tip", "bottom", "back"):
        for i, division in enumerate(DIVISIONS):
            straight = level == "tip" and division == "shoulder" and sloped
            dense = {"tooth": "end", "shoulder": "start", "opening": None}[division]
            center = None if straight else ORIGIN
            edges.append(Edge(f"{level}.{COLUMNS[i]}", f"{level}.{COLUMNS[i + 1]}", division, center, dense))
    for column in COLUMNS:
        edges.append(Edge(f"bore.{column}", f"tip.{column}", "tip"))
        edges.append(Edge(f"tip.{column}", f"bottom.{column}", "radial", None, "end"))
        edges.append(Edge(f"bottom.{column}", f"back.{column}", "yoke", None, "start"))
    return tuple(edges)


def _patches() -> tuple[Patch, ...]:
    def patch(name: str, low: str, high: str, i: int, core: str | None, overhang: bool) -> Patch:
        a, b = COLUMNS[i], COLUMNS[i + 1]
        return Patch(name, (f"{low}.{a}", f"{high}.{a}", f"{high}.{b}", f"{low}.{b}"), core, overhang)

    return (
        patch("tooth tip", "bore", "tip", 0, "lamination", True),
        patch("tip shoulder", "bore", "tip", 1, "lamination", True),
        patch("slot opening", "bore", "tip", 2, None, True),
        patch("tooth", "tip", "bottom", 0, "lamination", True),
        patch("slot behind the shoulder", "tip", "bottom", 1, "winding", True),
        patch("slot behind the opening", "tip", "bottom", 2, "winding", True),
        *(patch(f"yoke {i}", "bottom", "back", i, "lamination", False) for i in range(3)),
    )


def _check_tip(
    d: StatorDimensions, keys: SemiClosedSlots, underside: tuple[Point, Point], where: str
) -> None:
    """Refuse a tip so wide that its straight underside cuts into the bore."""
    (x0, y0), (x1, y1) = underside
    along = x1 - x0, y1 - y0
    length = math.hypot(*along)
    share = min(1.0, max(0.0, -(x0 * along[0] + y0 * along[1]) / length**2))
    nearest = math.hypot(x0 + share * along[0], y0 + share * along[1])
    if keys.wedge_height_mm > 0.0 and nearest <= d.bore_radius:
        raise GeometryError(
            f"{where}: slots.tip_height_mm = {keys.tip_height_mm:g} is too little for tips as wide as "
            f"slots.count = {d.slots} makes them: their underside would cut into the bore; raise the tip"
        )


def _check(d: StatorDimensions, keys: SemiClosedSlots, half: float, tip_radius: float, where: str) -> None:
    if tip_radius >= d.slot_radius:
        raise GeometryError(
            f"{where}: slots.tip_height_mm + slots.wedge_height_mm = "
            f"{keys.tip_height_mm + keys.wedge_height_mm:g} leaves no slot below core.yoke_thickness_mm: "
            f"the whole tooth is {1e3 * (d.slot_radius - d.bore_radius):g} mm high"
        )
    free = d.half_pitch - tooth_side_angle(half, d.bore_radius)
    if math.asin(min(1.0, keys.opening_width_mm / 2e3 / d.bore_radius)) >= free:
        raise GeometryError(
            f"{where}: slots.opening_width_mm = {keys.opening_width_mm:g} and slots.tooth_width_mm = "
            f"{keys.tooth_width_mm:g} leave no tooth tip at the bore; narrow the opening "
            f"or use parallel_tooth"
        )
