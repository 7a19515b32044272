import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from example_stators import PARALLEL_TOOTH, SEMI_CLOSED, SLOTS, stator
from statorhom.errors import GeometryError

ROUND = SLOTS["round_bottom"]
IMPOSSIBLE = {
    "bore as large as the core": ({}, {"bore_diameter_mm": 120.0}, "bore_diameter_mm", "outer_diameter_mm"),
    "yoke too thick": ({}, {"yoke_thickness_mm": 25.0}, "yoke_thickness_mm", "bore_diameter_mm"),
    "teeth overlap": ({"tooth_width_mm": 6.2}, {}, "tooth_width_mm", "count"),
    "too many teeth": ({"count": 80}, {}, "tooth_width_mm", "count"),
    "slots overlap": (SLOTS["parallel_slot"] | {"slot_width_mm": 6.2}, {}, "slot_width_mm", "count"),
    "tip too high": (SEMI_CLOSED | {"tip_height_mm": 15.85}, {}, "tip_height_mm", "yoke_thickness_mm"),
    "wedge too high": (SEMI_CLOSED | {"wedge_height_mm": 15.1}, {}, "wedge_height_mm", "yoke_thickness_mm"),
    "opening wider than the slot": (
        SEMI_CLOSED | {"opening_width_mm": 3.2},
        {},
        "opening_width_mm",
        "tooth_width_mm",
    ),
    "opening wider than the bore": (
        SEMI_CLOSED | {"opening_width_mm": 90.0},
        {},
        "opening_width_mm",
        "tooth_width_mm",
    ),
    "round bottom wider than deep": (ROUND | {"count": 6}, {}, "tooth_width_mm", "yoke_thickness_mm"),
    # the centre of the arc lies above the bore, the point where it leaves the tooth below the tooth's end
    "round bottom begins below the bore": (
        ROUND | {"count": 8, "tooth_width_mm": 2.0},
        {},
        "tooth_width_mm",
        "yoke_thickness_mm",
    ),
}


@pytest.mark.parametrize(("slots", "core", "first", "second"), IMPOSSIBLE.values(), ids=IMPOSSIBLE)
def test_an_impossible_geometry_is_one_line_with_the_two_keys(slots, core, first, second):
    with pytest.raises(GeometryError) as error:
        stator(PARALLEL_TOOTH | slots if "shape" not in slots else slots, core=core)
    message = str(error.value)
    assert message.startswith("stator.toml: ") and "\n" not in message
    assert first in message and second in message


def test_the_file_is_named_on_one_line_whatever_it_is_called():
    with pytest.raises(GeometryError) as error:
        stator(PARALLEL_TOOTH | {"tooth_width_mm": 7.0}, path="two\nlines.toml")
    assert "\n" not in str(error.value)


def test_lengths_are_metres():
    d = stator().dimensions
    assert (d.bore_radius, d.slot_radius, d.outer_radius) == pytest.approx((0.035, 0.05085, 0.06))
    assert (d.length, d.overhang) == pytest.approx((0.0805, 0.025))


def test_the_yoke_of_a_plain_ring_reaches_down_to_the_bore():
    d = stator(SLOTS["none"], core={"yoke_thickness_mm": 50.0}).dimensions
    assert d.slot_radius == d.bore_radius


@st.composite
def plausible(draw):
    """Dimensions as somebody might type them, good or bad: mostly in proportion, sometimes out of it."""
    outer = draw(st.floats(40.0, 500.0))
    bore = outer * draw(st.floats(0.3, 0.9))
    count = draw(st.integers(3, 96))
    pitch = 3.14 * bore / count
    shape = draw(st.sampled_from(["parallel_tooth", "semi_closed", "round_bottom", "parallel_slot", "none"]))
    core = {
        "outer_diameter_mm": outer,
        "bore_diameter_mm": bore,
        "length_mm": outer * draw(st.floats(0.1, 3.0)),
        "yoke_thickness_mm": (outer - bore) / 2 * draw(st.floats(0.1, 1.05)),
    }
    width = {
        "slot_width_mm" if shape == "parallel_slot" else "tooth_width_mm": pitch * draw(st.floats(0.2, 1.05))
    }
    tips = {
        "opening_width_mm": pitch * draw(st.floats(0.05, 0.6)),
        "tip_height_mm": outer * draw(st.floats(0.002, 0.05)),
        "wedge_height_mm": outer * draw(st.floats(0.0, 0.05)),
    }
    slots = {"shape": shape, "count": count}
    slots |= {} if shape == "none" else width
    slots |= tips if shape == "semi_closed" else {}
    overhang = {"overhang_length_mm": outer * draw(st.floats(0.02, 0.5))}
    return core, slots, overhang


@given(plausible())
@settings(deadline=None, max_examples=200)
def test_any_dimensions_fill_the_core_or_are_refused(dimensions):
    core, slots, winding = dimensions
    try:
        geometry = stator(slots, core=core, winding=winding, frame=None, machine=None)
    except GeometryError as error:
        assert "\n" not in str(error) and "stator.toml: " in str(error)
        return
    d, section = geometry.dimensions, geometry.section
    ring = d.half_pitch / 2 * (d.outer_radius**2 - d.bore_radius**2)
    assert all(section.area(patch) > 0 for patch in section.patches)
    assert sum(section.area(patch) for patch in section.patches) == pytest.approx(ring, rel=1e-9)


def test_a_tip_whose_underside_cuts_into_the_bore_is_refused():
    """Three wide tips on a small bore: the chord from tooth to opening dips below the bore's arc."""
    slots = {"shape": "semi_closed", "count": 3, "tooth_width_mm": 7.85, "opening_width_mm": 3.925}
    slots |= {"tip_height_mm": 0.3125, "wedge_height_mm": 0.3125}
    core = {"outer_diameter_mm": 40.0, "bore_diameter_mm": 30.0, "length_mm": 40.0, "yoke_thickness_mm": 2.5}
    with pytest.raises(GeometryError, match=r"slots.tip_height_mm.*slots.count"):
        stator(slots, core=core, winding=None, frame=None, machine=None)
