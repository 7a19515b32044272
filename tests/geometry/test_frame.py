import pytest

from example_stators import stator
from statorhom.errors import GeometryError

IMPOSSIBLE = {
    "frame smaller than the core": (
        {"frame": {"inner_diameter_mm": 110.0}},
        "frame.inner_diameter_mm",
        "core.outer_diameter_mm",
    ),
    "frame larger than the core": (
        {"frame": {"inner_diameter_mm": 121.0}},
        "frame.inner_diameter_mm",
        "core.outer_diameter_mm",
    ),
    "frame without a wall": (
        {"frame": {"outer_diameter_mm": 120.0}},
        "frame.outer_diameter_mm",
        "frame.inner_diameter_mm",
    ),
    "frame above the core": ({"frame": {"offset_mm": 80.5}}, "frame.offset_mm", "core.length_mm"),
    "frame below the core": ({"frame": {"offset_mm": -150.0}}, "frame.offset_mm", "frame.length_mm"),
    "upper shield in the overhang": (
        {"frame": {"length_mm": 140.0}},
        "the upper end shield",
        "winding.overhang_length_mm",
    ),
    "lower shield in the overhang": (
        {"frame": {"offset_mm": -25.0}},
        "the lower end shield",
        "winding.overhang_length_mm",
    ),
    "shield in the core": (
        {"frame": {"offset_mm": 0.0}, "winding": None},
        "the lower end shield",
        "core.length_mm",
    ),
    "shield in the core, though it clears the overhang": (
        {"frame": {"offset_mm": 0.0}, "machine": {"shield_bore_diameter_mm": 105.0}},
        "the lower end shield",
        "core.length_mm",
    ),
    "shield without a ring": (
        {"machine": {"shield_bore_diameter_mm": 120.0}},
        "machine.shield_bore_diameter_mm",
        "core.outer_diameter_mm",
    ),
    "shields without a frame": ({"frame": None}, "[machine]", "[frame]"),
}


@pytest.mark.parametrize(("tables", "first", "second"), IMPOSSIBLE.values(), ids=IMPOSSIBLE)
def test_what_does_not_fit_is_one_line_with_the_two_keys(tables, first, second):
    with pytest.raises(GeometryError) as error:
        stator(**tables)
    message = str(error.value)
    assert message.startswith("stator.toml: ") and "\n" not in message
    assert first in message and second in message


@pytest.mark.parametrize("inner", [119.7, 120.0, 120.3])
def test_a_press_fits_interference_is_accepted_and_the_frame_begins_at_the_core(inner):
    geometry = stator(frame={"inner_diameter_mm": inner})
    volume = geometry.step(("stack", "framed")).exact_volumes()["frame"]
    assert volume == stator().step(("stack", "framed")).exact_volumes()["frame"]


def test_shields_may_pass_outside_of_the_overhang():
    stator(frame={"length_mm": 120.0, "offset_mm": -19.75}, machine={"shield_bore_diameter_mm": 101.8})


def test_a_frame_that_ends_with_the_core_is_flush_in_spite_of_rounding():
    offset, length, core = 0.1, 50.2, 50.3
    assert offset + length != core
    frame = {"offset_mm": offset, "length_mm": length}
    geometry = stator(core={"length_mm": core}, frame=frame, machine=None)
    assert geometry.dimensions.frame.z_high == geometry.dimensions.length
    assert geometry.dimensions.frame.z_low == pytest.approx(1e-4)
