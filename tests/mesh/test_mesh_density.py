import math

import numpy as np
import pytest

from example_stators import PARALLEL_TOOTH, SLOTS, stator
from statorhom.mesh import MeshDensity, graded, mesh_step, uniform
from statorhom.mesh.section_mesh import mesh_section


def test_uniform_meshes_have_equal_cells_and_multiply_them():
    one, three = uniform(1), uniform(3)
    for division in one.cells:
        assert three.across(division) == 3 * one.across(division) == 3 * one.cells[division]
        assert three.along(division) == 3 * one.along(division)
    assert one.progression(4) == 1.0


def test_refinement_multiplies_rounds_half_up_and_never_coarsens():
    density = MeshDensity({"a": 1, "b": 3, "c": 4})
    refined = density.refined(1.5)
    assert [refined.across(k) for k in "abc"] == [2, 5, 6]
    assert [density.refined(0.3).across(k) for k in "abc"] == [1, 3, 4]
    assert [density.refined(1.5).refined(2.0).across(k) for k in "abc"] == [3, 9, 12]
    assert [density.across(k) for k in "abc"] == [1, 3, 4]


@pytest.mark.parametrize("division", ["tooth", "slot", "shoulder", "radial", "yoke", "core", "overhang"])
def test_the_graded_meshes_of_a_convergence_study_are_similar(division):
    base = graded().across(division)
    assert graded(1.5).across(division) == 1.5 * base
    assert graded(2.0).across(division) == 2 * base


def test_cells_wider_or_longer_than_allowed_are_split_before_they_are_refined():
    density = MeshDensity({"slot": 2, "core": 3}, widest=math.radians(5.0), longest=1.0)
    assert density.across("slot", math.radians(10.0)) == 2
    assert density.across("slot", math.radians(10.1)) == 4
    assert density.refined(1.5).across("slot", math.radians(10.1)) == 6
    assert density.along("core", 3.0) == 3
    assert density.along("core", 3.1) == 6
    assert density.along("core", 3.1, share=0.5) == 3
    assert density.along("core", 1.0, share=0.01) == 1


def test_single_divisions_of_the_graded_mesh_can_be_chosen():
    assert graded(2.0, core=5).along("core") == 10
    assert graded(2.0, core=5).across("yoke") == graded(2.0).across("yoke")


def test_the_grading_is_the_limit_of_the_ratio_of_the_end_cells():
    density = MeshDensity({}, grading=20.0)
    ratios = [density.progression(n) ** (n - 1) for n in (2, 4, 8, 200)]
    assert ratios == sorted(ratios)
    assert ratios[-1] == pytest.approx(20.0, rel=0.02)
    assert density.progression(1) == 1.0
    # similar meshes: every other node of the twice as fine mesh is one of the coarse mesh
    coarse, fine = (np.cumsum(density.progression(n) ** np.arange(n)) for n in (3, 6))
    np.testing.assert_allclose(fine[1::2] / fine[-1], coarse / coarse[-1], rtol=1e-14)


def test_cells_shrink_towards_the_ends_of_the_core_by_the_end_grading():
    density = MeshDensity({}, end_grading=10.0)
    for cells in (1, 2, 5, 6):
        levels = density.levels(cells)
        assert len(levels) == cells + 1 and (levels[0], levels[-1]) == (0.0, 1.0)
        np.testing.assert_allclose(levels, 1 - levels[::-1], atol=1e-15)
    long = np.diff(density.levels(400))
    assert long.max() / long.min() == pytest.approx(10.0, rel=0.02)
    np.testing.assert_allclose(density.levels(8)[::2], density.levels(4), rtol=1e-14)
    np.testing.assert_allclose(np.diff(MeshDensity({}).levels(4)), 0.25)


def test_the_core_is_graded_as_a_whole_where_nothing_cuts_it():
    density = MeshDensity(dict(uniform().cells) | {"core": 4}, end_grading=10.0)

    def corners(geometry, kinds):
        mesh = mesh_step(geometry.step(kinds), density)
        z = mesh.nodes[np.unique(mesh.elements_of("lamination")[:, :8]), 2]
        return np.unique(z.round(9))

    long, short = stator(), stator(frame={"offset_mm": 0.0, "length_mm": 40.25}, machine=None)
    whole = 0.0805 * density.levels(4)
    for geometry, kinds in ((long, ("stack", "wound")), (long, ("stack", "framed")), (short, ("stack",))):
        np.testing.assert_allclose(corners(geometry, kinds), whole, atol=1e-9)
    np.testing.assert_allclose(corners(short, ("stack", "framed")), np.linspace(0, 0.0805, 5), atol=1e-9)


@pytest.mark.parametrize("slots", [PARALLEL_TOOTH, SLOTS["parallel_slot"], SLOTS["semi_closed with wedge"]])
def test_cells_shrink_towards_the_tooth_root(slots):
    geometry = stator(slots)
    section = geometry.section
    flat = mesh_section(section, graded(2.0))
    root = np.array(section.points["bottom.side"])
    size = {}
    for patch in section.patches:
        corners = flat.points[flat.quads[patch.name][..., :4]].reshape(-1, 4, 2)
        x, y = corners.transpose(2, 0, 1)
        area = 0.5 * np.abs(((x - np.roll(x, -1, 1)) * (y + np.roll(y, -1, 1))).sum(axis=1))
        touches = np.linalg.norm(corners - root, axis=2).min(axis=1) < 1e-9
        size[patch.name] = area, touches
    at_root = np.concatenate([area[touches] for area, touches in size.values()])
    assert len(at_root) == 4
    for area, touches in size.values():
        if touches.any():
            # every patch is smallest where it touches the root
            assert area[touches][0] == area.min() < 0.1 * area.max()


def test_refining_a_mesh_multiplies_its_elements():
    step = stator().step(("stack", "wound"))
    coarse, fine = (len(mesh_step(step, graded(f)).elements) for f in (1.0, 2.0))
    assert fine == 8 * coarse


def test_teeth_that_no_winding_holds_may_get_more_cells():
    density = MeshDensity(graded().cells, bare={"radial": 6})
    geometry = stator(PARALLEL_TOOTH)
    counts = {
        kinds: [len(mesh_step(geometry.step(kinds), d).elements) for d in (density, graded())]
        for kinds in (("stack",), ("stack", "wound"))
    }
    bare, usual = counts["stack",]
    assert bare > usual
    assert counts["stack", "wound"][0] == counts["stack", "wound"][1]
    assert density.refined(1.5).of_empty_slots().across("radial") == 9
