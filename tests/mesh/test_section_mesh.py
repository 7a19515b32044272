import numpy as np
import pytest

from example_stators import SLOTS, STEPS, STEPS_OF_RING, stator
from statorhom.mesh import graded, uniform
from statorhom.mesh.quality import scaled_jacobians
from statorhom.mesh.section_mesh import mesh_section

CASES = [(name, density) for name in SLOTS for density in ("uniform", "graded")]
DENSITY = {"uniform": uniform(2), "graded": graded(1.5)}


def section_of(name):
    steps = STEPS_OF_RING if name == "none" else STEPS
    return stator(SLOTS[name]).step(steps["machine"]).section


@pytest.mark.parametrize(("name", "density"), CASES)
def test_the_grid_of_a_patch_runs_from_corner_to_corner(name, density):
    section = section_of(name)
    flat = mesh_section(section, DENSITY[density])
    for patch in section.patches:
        grid = flat.quads[patch.name]
        at = [grid[0, 0, 0], grid[-1, 0, 1], grid[-1, -1, 2], grid[0, -1, 3]]
        corners = [section.points[corner] for corner in patch.corners]
        np.testing.assert_allclose(flat.points[at], corners, atol=1e-12)


@pytest.mark.parametrize(("name", "density"), CASES)
def test_neighbouring_patches_share_their_nodes_and_all_are_used(name, density):
    section = section_of(name)
    flat = mesh_section(section, DENSITY[density])
    used = np.unique(np.concatenate([grid.ravel() for grid in flat.quads.values()]))
    assert np.array_equal(used, np.arange(len(flat.points)))
    for patch in section.patches:
        for other in section.patches:
            common = set(patch.corners) & set(other.corners)
            if patch is not other and len(common) == 2:
                nodes = np.intersect1d(flat.quads[patch.name], flat.quads[other.name])
                cells = DENSITY[density].across(
                    section.edge(*common).division, section.width_on_back(section.edge(*common).division)
                )
                assert len(nodes) == 2 * cells + 1


@pytest.mark.parametrize(("name", "density"), CASES)
def test_cells_are_counter_clockwise_and_sound(name, density):
    flat = mesh_section(section_of(name), DENSITY[density])
    for grid in flat.quads.values():
        assert scaled_jacobians(flat.points, grid).min() > 0.4
