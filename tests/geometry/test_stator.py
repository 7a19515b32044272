import math
from pathlib import Path

import pytest

from example_stators import EVERY_STEP, PARALLEL_TOOTH, SEMI_CLOSED, SLOTS, STEPS, stator
from statorhom.errors import GeometryError
from statorhom.geometry import stator_geometry
from statorhom.study.geometry_file import read_geometry

GEOMETRIES = Path(__file__).resolve().parents[2] / "geometries"


def ring(outer_mm, inner_mm, length_mm):
    return math.pi / 4 * (outer_mm**2 - inner_mm**2) * length_mm * 1e-9


def test_the_papers_machine_has_the_volumes_of_the_paper():
    path = GEOMETRIES / "550w-induction-36-slots.toml"
    volumes = stator_geometry(read_geometry(path), path).step(("stack", "wound")).exact_volumes()
    assert volumes["lamination"] == pytest.approx(394.3e-6, rel=1e-3)
    assert volumes["winding"] + volumes["overhang"] == pytest.approx(420.0e-6, rel=1e-3)
    # and with them its densities
    assert 3.08 / volumes["lamination"] == pytest.approx(7810.5, rel=1e-4)
    assert (4.41 - 3.08) / (volumes["winding"] + volumes["overhang"]) == pytest.approx(3166.4, rel=1e-4)


def test_a_slot_between_parallel_sides_has_the_area_of_a_hand_calculation():
    volumes = stator(SLOTS["parallel_slot"]).step(STEPS["wound"]).exact_volumes()
    w, bore, bottom, pitch = 2.8, 35.0, 50.85, 2 * math.pi / 36

    def below(r):  # area of a strip of width w from the axis to the circle r
        return r**2 * math.asin(w / 2 / r) + w / 2 * math.sqrt(r**2 - w**2 / 4)

    area = below(bottom) - below(bore)
    assert volumes["winding"] == pytest.approx(36 * area * 80.5e-9, rel=1e-12)
    assert volumes["lamination"] == pytest.approx(ring(120, 70, 80.5) - 36 * area * 80.5e-9, rel=1e-12)
    assert volumes["overhang"] == pytest.approx(36 * pitch / 2 * (bottom**2 - bore**2) * 50e-9, rel=1e-12)


def test_a_round_bottom_takes_from_an_open_slot_what_lies_outside_of_its_arc():
    open_slot = stator(PARALLEL_TOOTH).step(STEPS["wound"]).exact_volumes()["winding"]
    half, bottom, b = 1.5, 50.85, math.pi / 36
    at = (bottom + half) / (1 + math.sin(b))
    radius = bottom - at
    # half a slot beyond the line from the arc's centre to the tangent point: the disc's sector ...
    tangent = at * math.cos(b)
    disc = radius**2 * (math.pi / 2 + b) / 2
    # ... and the open slot, by Green's theorem along tooth side, bottom and that line
    side = math.asin(half / bottom)
    corner = bottom * math.cos(side)
    behind = (
        bottom**2 * (b - side) / 2 - half * (corner - tangent) / 2 - tangent * (at * math.sin(b) - half) / 2
    )
    missing = behind - disc
    rounded = stator(SLOTS["round_bottom"]).step(STEPS["wound"]).exact_volumes()["winding"]
    assert open_slot - rounded == pytest.approx(72 * missing * 80.5e-9, rel=1e-9)


def test_tips_close_the_slot_and_the_opening_stays_empty():
    def winding(slots):
        volumes = stator(slots).step(STEPS["wound"]).exact_volumes()
        return volumes["winding"], volumes["lamination"], volumes["overhang"]

    open_slot, tipped, wedged = (
        winding(s) for s in (PARALLEL_TOOTH, SEMI_CLOSED, SEMI_CLOSED | {"wedge_height_mm": 1.0})
    )
    assert open_slot[0] > tipped[0] > wedged[0]
    # what neither steel nor winding fills is the opening: 1.5 mm wide, 0.8 mm high
    for closed in (tipped, wedged):
        empty = ring(120, 70, 80.5) - closed[0] - closed[1]
        assert empty == pytest.approx(36 * 1.5 * 0.8 * 80.5e-9, rel=2e-3)
        assert closed[2] == pytest.approx(ring(101.7, 70, 50.0), rel=1e-12)


def test_frame_and_shields_are_rings():
    volumes = stator().step(STEPS["machine"]).exact_volumes()
    assert volumes["frame"] == pytest.approx(ring(130, 120, 150), rel=1e-12)
    assert volumes["machine"] == pytest.approx(ring(130, 40, 16), rel=1e-12)


@pytest.mark.parametrize(("name", "kinds"), EVERY_STEP)
def test_a_step_has_the_regions_of_its_steps_in_their_order(name, kinds):
    regions = stator(SLOTS[name]).step(kinds).regions
    wound = ("winding", "overhang") if "wound" in kinds else ()
    added = tuple(r for k, r in (("framed", "frame"), ("machine", "machine")) if k in kinds)
    assert regions == ("lamination", *wound, *added)


SHIPPED_STATORS = [
    p for p in sorted(GEOMETRIES.glob("*.toml")) if "\n[core]" in p.read_text(encoding="utf-8")
]


@pytest.mark.parametrize("path", SHIPPED_STATORS, ids=lambda p: p.stem)
def test_every_step_that_a_shipped_geometry_has_tables_for_can_be_built(path):
    file = read_geometry(path)
    geometry = stator_geometry(file, path)
    tables = {"winding": "wound", "frame": "framed", "machine": "machine"}
    kinds = ("stack", *(kind for name, kind in tables.items() if getattr(file, name) is not None))
    assert all(volume > 0 for volume in geometry.step(kinds).exact_volumes().values())


@pytest.mark.parametrize(
    ("kinds", "removed", "words"),
    [
        (("stack", "wound"), {"winding": None}, "[winding]"),
        (("stack", "framed"), {"frame": None, "machine": None}, "[frame]"),
        (("stack", "framed", "machine"), {"machine": None}, "[machine]"),
        (("stack", "machine"), {}, "add a framed stage"),
    ],
)
def test_a_step_without_its_table_says_which_to_add(kinds, removed, words):
    with pytest.raises(GeometryError) as error:
        stator(**removed).step(kinds)
    assert words in str(error.value) and "\n" not in str(error.value)


def test_a_plain_ring_takes_no_winding():
    with pytest.raises(GeometryError, match="no slots for a winding; choose a slot shape"):
        stator(SLOTS["none"]).step(("stack", "wound"))
