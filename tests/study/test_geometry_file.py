from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from pydantic import ValidationError

from statorhom.errors import InputFileError
from statorhom.study.geometry_file import NoSlots, ParallelSlots, SemiClosedSlots, read_geometry

GEOMETRIES = Path(__file__).resolve().parents[2] / "geometries"


def test_papers_machine_has_the_printed_dimensions() -> None:
    geometry = read_geometry(GEOMETRIES / "550w-induction-36-slots.toml")
    core, slots, winding = geometry.core, geometry.slots, geometry.winding
    assert (core.outer_diameter_mm, core.bore_diameter_mm) == (120.0, 70.0)
    assert (core.length_mm, core.yoke_thickness_mm) == (80.5, 9.15)
    assert (slots.count, slots.shape, slots.tooth_width_mm) == (36, "parallel_tooth", 3.0)
    assert winding is not None and winding.overhang_length_mm == 25.0
    assert geometry.frame is None and geometry.lamination is None and geometry.machine is None


def test_the_other_machines_have_other_slots() -> None:
    traction = read_geometry(GEOMETRIES / "traction-48-slots.toml")
    hairpin = read_geometry(GEOMETRIES / "hairpin-54-slots.toml")
    assert isinstance(traction.slots, SemiClosedSlots) and traction.slots.count == 48
    assert isinstance(hairpin.slots, ParallelSlots) and hairpin.slots.count == 54
    assert traction.frame is not None and traction.machine is not None


def test_plain_ring_has_a_default_number_of_sectors(folder: Any) -> None:
    folder.edit("ring.toml", 'count = 36\nshape = "parallel_tooth"\ntooth_width_mm = 3.0', 'shape = "none"')
    assert read_geometry(folder.geometry).slots == NoSlots(shape="none", count=36)


def test_a_bare_core_needs_no_other_section(folder: Any) -> None:
    folder.edit("ring.toml", "[winding]\noverhang_length_mm = 25.0", "")
    assert read_geometry(folder.geometry).winding is None


def test_whole_numbers_are_lengths_too(folder: Any) -> None:
    folder.edit("ring.toml", "120.0", "120")
    assert read_geometry(folder.geometry).core.outer_diameter_mm == 120.0


def test_cannot_be_changed(folder: Any) -> None:
    with pytest.raises(ValidationError):
        read_geometry(folder.geometry).core.length_mm = 1.0


@pytest.mark.parametrize(
    ("old", "new", "fragments"),
    [
        (
            '"parallel_tooth"',
            '"paralel_tooth"',
            ["slots", '"paralel_tooth" is not one of', 'did you mean "parallel_tooth"?'],
        ),
        ('shape = "parallel_tooth"\n', "", ["slots: shape is missing", "add this key"]),
        ("count = 36", "count = 36.0", ["slots.count", "must be a whole number, but is 36.0"]),
        ("count = 36", "count = 2", ["slots.count", "must be at least 3, but is 2"]),
        ("count = 36", "count = true", ["slots.count", "must be a whole number, but is true"]),
        ("120.0", "0.0", ["core.outer_diameter_mm", "must be greater than 0, but is 0.0"]),
        ("120.0", "inf", ["core.outer_diameter_mm", "must be a finite number"]),
        ("120.0", "[120.0]", ["core.outer_diameter_mm", "must be a number, but is [120.0]"]),
        ("length_mm = 80.5\n", "", ["core.length_mm", "is missing"]),
        ("schema = 1", "schema = 2", ["schema", "2 is not one of 1"]),
        ("schema = 1\n", "", ["schema", "is missing"]),
        ('name = "small ring"', 'name = "small\\nring"', ["name", "printable text on one line"]),
        (
            'name = "small ring"',
            'name = "x"\nkind = "wing"',
            ["a wing is no stator", 'use simulate, fit, run or report, or a geometry of kind = "stator"'],
        ),
        (
            'name = "small ring"',
            'name = "x"\nkind = "plate"\nplate = { length_mm = 300.0 }',
            ["a plate is no stator"],
        ),
        ('name = "small ring"', 'name = "x"\nkind = "rotor"', ['kind: "rotor" is not one of stator']),
        ("[winding]", "[windings]", ['unknown key "windings"', 'did you mean "winding"?']),
        ("[winding]", "[wicklung]", ['unknown key "wicklung"', '"winding"']),
    ],
)
def test_single_keys_are_checked(folder: Any, old: str, new: str, fragments: list[str]) -> None:
    folder.edit("ring.toml", old, new)
    with pytest.raises(InputFileError) as caught:
        read_geometry(folder.geometry)
    message = str(caught.value)
    assert message.startswith(f"{folder.geometry}: ")
    assert "\n" not in message and "; " in message
    for fragment in fragments:
        assert fragment in message
