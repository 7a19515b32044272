import itertools

import numpy as np
import pytest
from hexahedra import least_scaled_jacobian, volumes
from hypothesis import given, settings
from hypothesis import strategies as st

from example_stators import EVERY_STEP, SLOTS, STEPS, stator
from statorhom.errors import GeometryError
from statorhom.mesh import MeshDensity, graded, mesh_step, uniform


def region_volumes(mesh):
    cells = volumes(mesh.nodes, mesh.elements)
    return {name: cells[mesh.region == i].sum() for i, name in enumerate(mesh.regions)}


@pytest.mark.parametrize(("name", "kinds"), EVERY_STEP)
def test_the_mesh_has_the_exact_volumes(name, kinds):
    step = stator(SLOTS[name]).step(kinds)
    mesh = mesh_step(step, graded())
    exact = step.exact_volumes()
    assert mesh.regions == tuple(exact)
    for region, volume in region_volumes(mesh).items():
        assert 2 * mesh.slots * volume == pytest.approx(exact[region], rel=1e-4)


@pytest.mark.parametrize("name", ["few slots", "round_bottom", "wide round_bottom"])
def test_what_volumes_lack_falls_with_the_fourth_power_of_the_cells(name):
    step = stator(SLOTS[name]).step(("stack",))
    exact = step.exact_volumes()["lamination"]
    # along arcs the mid-sides are the only points between corners: parabolas
    coarse, fine = (mesh_step(step, uniform(f)) for f in (1, 2))
    errors = [2 * m.slots * region_volumes(m)["lamination"] / exact - 1 for m in (coarse, fine)]
    assert errors[0] / errors[1] == pytest.approx(16, rel=0.1)


@pytest.mark.parametrize("kinds", STEPS.values(), ids=STEPS)
def test_the_volumes_of_narrow_slots_are_exact_on_the_coarsest_mesh(kinds):
    step = stator().step(kinds)
    for region, volume in region_volumes(mesh_step(step, uniform())).items():
        assert 72 * volume == pytest.approx(step.exact_volumes()[region], rel=1e-7)


@pytest.mark.parametrize(("name", "kinds"), EVERY_STEP)
@pytest.mark.parametrize("density", [uniform(), graded()], ids=["uniform", "graded"])
def test_no_cell_is_folded_or_a_needle(name, kinds, density):
    mesh = mesh_step(stator(SLOTS[name]).step(kinds), density)
    assert least_scaled_jacobian(mesh.nodes, mesh.elements).min() > 0.4


@pytest.mark.parametrize("name", SLOTS)
def test_all_nodes_of_the_bore_and_the_back_lie_on_circles(name):
    geometry = stator(SLOTS[name])
    mesh = mesh_step(geometry.step(("stack",)), uniform())
    d = geometry.dimensions
    radius = np.hypot(*mesh.nodes[:, :2].T)
    back = np.abs(radius - d.outer_radius) < 1e-5
    np.testing.assert_allclose(radius[back], d.outer_radius, rtol=1e-12)
    bore = np.abs(radius - d.bore_radius) < 1e-5
    np.testing.assert_allclose(radius[bore], d.bore_radius, rtol=1e-12)
    # corners and mid-sides
    assert len(np.unique(mesh.nodes[back, 2].round(9))) == 7
    at_end = np.count_nonzero(back & (mesh.nodes[:, 2] == 0))
    divisions = [geometry.section.edge(a, b).division for a, b in itertools.pairwise(geometry.section.outer)]
    assert at_end == 2 * sum(uniform().across(division) for division in divisions) + 1


@pytest.mark.parametrize("density", [uniform(), graded()], ids=["uniform", "graded"])
def test_the_slot_bottom_lies_on_its_circle(density):
    geometry = stator()
    mesh = mesh_step(geometry.step(("stack", "wound")), density)
    slot = np.unique(mesh.elements_of("winding"))
    yoke = np.intersect1d(slot, np.unique(mesh.elements_of("lamination")))
    radius = np.hypot(*mesh.nodes[yoke, :2].T)
    side = np.abs(mesh.nodes[yoke, 1] - 1.5e-3) < 1e-9
    assert np.count_nonzero(~side) >= 7
    np.testing.assert_allclose(radius[~side], 0.05085, rtol=1e-12)


def test_the_round_bottom_lies_on_its_arc():
    mesh = mesh_step(stator(SLOTS["wide round_bottom"]).step(("stack", "wound")), uniform())
    shared = np.intersect1d(mesh.elements_of("winding"), mesh.elements_of("lamination"))
    x, y = mesh.nodes[shared, :2].T
    b = np.pi / 12
    at = (0.05085 + 0.003) / (1 + np.sin(b))
    beyond = x > at * np.cos(b) + 1e-9
    # four cells: corners in seven planes of nodes, mid-sides in four
    assert np.count_nonzero(beyond) == 4 * 7 + 4 * 4
    distance = np.hypot(x - at * np.cos(b), y - at * np.sin(b))
    np.testing.assert_allclose(distance[beyond], 0.05085 - at, rtol=1e-10)
    np.testing.assert_allclose(y[~beyond], 0.003, rtol=1e-10)


@pytest.mark.parametrize("name", SLOTS)
def test_the_planes_of_symmetry_hold_the_nodes_on_them_exactly(name):
    mesh = mesh_step(stator(SLOTS[name]).step(("stack",)), graded())
    angle = np.arctan2(mesh.nodes[:, 1], mesh.nodes[:, 0])
    half = np.pi / mesh.slots
    assert angle.min() == 0.0 and np.all(mesh.nodes[mesh.tooth_plane, 1] == 0.0)
    np.testing.assert_allclose(angle[mesh.slot_plane], half, rtol=1e-15)
    rest = np.delete(angle, np.concatenate([mesh.tooth_plane, mesh.slot_plane]))
    assert np.all((rest > 1e-6) & (rest < half - 1e-6))


def cells_at(mesh, low, high):
    """Numbers of layers of cells per region between two axial positions (m)."""
    z = mesh.nodes[mesh.elements[:, [0, 4]], 2].round(9)
    found = {}
    for i, region in enumerate(mesh.regions):
        layers = np.unique(z[mesh.region == i], axis=0)
        found[region] = int(np.count_nonzero((layers[:, 0] >= low) & (layers[:, 1] <= high)))
    return found


def test_a_frame_that_ends_on_the_core_shares_its_cells():
    geometry = stator(frame={"offset_mm": 16.1, "length_mm": 80.5}, machine=None)
    mesh = mesh_step(geometry.step(("stack", "framed")), MeshDensity(dict(uniform().cells) | {"core": 10}))
    assert cells_at(mesh, 0.0, 0.0161) == {"lamination": 2, "frame": 0}
    assert cells_at(mesh, 0.0161, 0.0805) == {"lamination": 8, "frame": 8}
    assert cells_at(mesh, 0.0805, 0.0966) == {"lamination": 0, "frame": 2}
    z = mesh.nodes[:, 2]
    shared = np.intersect1d(mesh.elements_of("lamination"), mesh.elements_of("frame"))
    np.testing.assert_allclose(np.hypot(*mesh.nodes[shared, :2].T), 0.06, rtol=1e-12)
    assert z[shared].min() == pytest.approx(0.0161) and z[shared].max() == 0.0805


def test_long_cores_and_wide_slots_get_more_cells():
    long = mesh_step(stator(core={"length_mm": 400.0}, frame=None, machine=None).step(("stack",)), graded())
    assert (
        cells_at(long, 0.0, 0.4)["lamination"] == 8
    )  # twice the usual number: unrefined cells are at most as long as the outer radius
    few = mesh_step(stator(SLOTS["few slots"]).step(("stack",)), graded(1.0, core=1))
    end = few.nodes[(few.nodes[:, 2] == 0) & (np.abs(np.hypot(*few.nodes[:, :2].T) - 0.06) < 1e-9)]
    angle = np.sort(np.arctan2(end[:, 1], end[:, 0]))
    tooth = np.arcsin(7.0 / 50.85)
    assert np.count_nonzero(angle <= tooth + 1e-9) == 2 * 2 + 1
    assert np.count_nonzero(angle >= tooth - 1e-9) == 2 * 4 + 1


def test_slivers_are_refused():
    slots = SLOTS["semi_closed"] | {
        "opening_width_mm": 3.1065,
        "tip_height_mm": 0.05,
        "wedge_height_mm": 15.5,
    }
    with pytest.raises(GeometryError) as error:
        mesh_step(stator(slots).step(("stack",)), uniform())
    message = str(error.value)
    assert message.startswith("stator.toml: ") and "\n" not in message
    assert "tip shoulder" in message and "slots.count = 36" in message


@st.composite
def plausible_steps(draw):
    outer = draw(st.floats(40.0, 500.0))
    bore = outer * draw(st.floats(0.4, 0.85))
    count = draw(st.integers(4, 72))
    pitch = 3.14 * bore / count
    shape = draw(st.sampled_from(["parallel_tooth", "semi_closed", "round_bottom", "parallel_slot"]))
    width = "slot_width_mm" if shape == "parallel_slot" else "tooth_width_mm"
    slots = {"shape": shape, "count": count, width: pitch * draw(st.floats(0.25, 0.8))}
    if shape == "semi_closed":
        slots |= {
            "opening_width_mm": pitch * draw(st.floats(0.05, 0.5)),
            "tip_height_mm": outer * draw(st.floats(0.004, 0.02)),
            "wedge_height_mm": outer * draw(st.floats(0.0, 0.02)),
        }
    length = outer * draw(st.floats(0.2, 2.0))
    core = {
        "outer_diameter_mm": outer,
        "bore_diameter_mm": bore,
        "length_mm": length,
        "yoke_thickness_mm": (outer - bore) / 2 * draw(st.floats(0.2, 0.8)),
    }
    overhang = outer * draw(st.floats(0.05, 0.4))
    below, above = (overhang * draw(st.floats(1.01, 2.0)) for _ in range(2))
    frame = {
        "inner_diameter_mm": outer,
        "outer_diameter_mm": outer * draw(st.floats(1.02, 1.2)),
        "length_mm": below + length + above,
        "offset_mm": -below,
    }
    machine = {
        "shield_thickness_mm": outer * draw(st.floats(0.02, 0.1)),
        "shield_bore_diameter_mm": outer * draw(st.floats(0.1, 0.9)),
    }
    tables = {"core": core, "winding": {"overhang_length_mm": overhang}, "frame": frame, "machine": machine}
    return slots, tables


@given(plausible_steps(), st.sampled_from(list(STEPS.values())))
@settings(deadline=None, max_examples=60)
def test_any_plausible_machine_is_refused_or_has_exact_volumes_and_sound_cells(machine, kinds):
    slots, tables = machine
    try:
        step = stator(slots, **tables).step(kinds)
        mesh = mesh_step(step, graded())
    except GeometryError as error:
        assert "\n" not in str(error) and "stator.toml: " in str(error)
        return
    for region, volume in region_volumes(mesh).items():
        assert 2 * mesh.slots * volume == pytest.approx(step.exact_volumes()[region], rel=3e-4)
    assert least_scaled_jacobian(mesh.nodes, mesh.elements).min() > 0.0
