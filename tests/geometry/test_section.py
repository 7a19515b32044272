import math

import pytest

from example_stators import SLOTS, stator
from statorhom.geometry.section import ORIGIN, Edge, Patch, Section, polar


def sector(inner, outer, angle):
    points = {
        "a": polar(inner, 0.0),
        "b": polar(outer, 0.0),
        "c": polar(outer, angle),
        "d": polar(inner, angle),
    }
    edges = (
        Edge("a", "b", "radial"),
        Edge("c", "b", "around", ORIGIN),
        Edge("c", "d", "radial"),
        Edge("a", "d", "around", ORIGIN),
    )
    return Section(points, edges, (Patch("sector", ("a", "b", "c", "d"), "lamination"),), ("b", "c"))


@pytest.mark.parametrize("angle", [0.01, 1.0, 3.0])
def test_the_area_of_a_sector_is_exact_whichever_way_its_edges_run(angle):
    section = sector(35.0, 60.0, angle)
    assert section.area(section.patches[0]) == pytest.approx(angle / 2 * (60.0**2 - 35.0**2), rel=1e-14)


def test_arcs_about_another_centre_count():
    # a unit square whose upper side bulges by a half disc, nearly
    top = Edge("c", "d", "x", (0.5, 1.0 - 1e-9))
    points = {"a": (0.0, 0.0), "b": (1.0, 0.0), "c": (1.0, 1.0), "d": (0.0, 1.0)}
    edges = (Edge("a", "b", "x"), Edge("b", "c", "y"), top, Edge("d", "a", "y"))
    section = Section(points, edges, (Patch("square", ("a", "b", "c", "d")),), ())
    assert section.area(section.patches[0]) == pytest.approx(1 + math.pi / 8, rel=1e-8)


def test_the_points_of_a_section_cannot_be_changed():
    with pytest.raises(TypeError):
        sector(1.0, 2.0, 1.0).points["a"] = (0.0, 0.0)


@pytest.mark.parametrize("name", SLOTS)
def test_every_slot_shape_covers_half_a_pitch_of_the_ring(name):
    geometry = stator(SLOTS[name])
    d, section = geometry.dimensions, geometry.section
    ring = d.half_pitch / 2 * (d.outer_radius**2 - d.bore_radius**2)
    assert sum(section.area(p) for p in section.patches) == pytest.approx(ring, rel=1e-12)
    assert all(section.area(p) > 0 for p in section.patches)


@pytest.mark.parametrize("name", SLOTS)
def test_opposite_sides_of_a_patch_have_equal_numbers_of_cells(name):
    section = stator(SLOTS[name]).section
    for patch in section.patches:
        a, b, c, d = patch.corners
        assert section.edge(a, b).division == section.edge(d, c).division
        assert section.edge(b, c).division == section.edge(a, d).division


@pytest.mark.parametrize("name", SLOTS)
def test_the_columns_of_the_back_make_up_half_a_pitch(name):
    geometry = stator(SLOTS[name])
    section = geometry.section
    divisions = {edge.division for edge in section.edges}
    total = sum(section.width_on_back(division) for division in divisions)
    assert total == pytest.approx(geometry.dimensions.half_pitch, rel=1e-12)
    assert section.width_on_back("yoke") == 0.0
