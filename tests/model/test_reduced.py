"""Bases per cell of a box of materials."""

import numpy as np
import pytest
import wound_box as stage

from statorhom.model.material_cells import features
from statorhom.model.material_span import material_point
from statorhom.model.reduced import material_box, reduce_harmonic


def test_every_material_is_trained_in_its_cell_and_around():
    training = [stage.winding(np.zeros(3)), *stage.draws(40, 3)]
    box = material_box(training, stage.wound().mesh.regions, most=5)
    assert len(box.training) == 5
    for materials in training:
        point = material_point(materials, stage.wound().mesh.regions)
        own = box.training[box.locate(point)[0]]
        assert any(np.array_equal(point.hooke, p.hooke) for p in own)
    for number, part in enumerate(box.training):
        assert len(part) >= 12
        assert box.locate(part[0]) == (number, 0)


def test_the_certified_error_is_below_the_tolerance_at_all_training_materials():
    assert 0.0 < stage.reduced().error <= stage.TOLERANCE
    assert max(r.size for c in stage.reduced().cells for r in c.rooms) < 0.2 * stage.space().size


def test_bases_have_unit_mass_and_diagonal_stiffness_at_the_reference():
    for part, cell in zip(stage.box().training, stage.reduced().cells, strict=True):
        for room in cell.rooms:
            mass = np.tensordot(part[0].density, room.mass, axes=1)
            np.testing.assert_allclose(mass, np.eye(room.size), atol=1e-8)
            stiffness = np.tensordot(stage.box().span.weights(part[0]), room.stiffness, axes=1)
            np.testing.assert_allclose(
                stiffness, np.diag(np.diag(stiffness)), atol=1e-8 * np.abs(stiffness).max()
            )


def test_rooms_need_fewer_vectors_than_their_cell_and_stand_on_the_same_snapshots():
    training = [stage.winding(np.zeros(3)), *stage.draws(60, 1)]
    regions = stage.wound().mesh.regions
    whole = material_box(training, regions, most=1)
    divided = material_box(training, regions, most=1, room_radius=0.5)
    assert (len(whole.rooms[0].members), len(divided.rooms[0].members) > 4) == (1, True)
    one, many = (
        reduce_harmonic(stage.wound(), stage.space(), box, stage.TOP_HZ, stage.TOLERANCE).cells[0]
        for box in (whole, divided)
    )
    np.testing.assert_array_equal(one.basis, many.basis)
    assert max(r.size for r in many.rooms) <= one.rooms[0].size
    assert np.mean([r.size for r in many.rooms]) < 0.8 * one.rooms[0].size
    assert many.error <= stage.TOLERANCE


def test_a_material_is_trained_in_its_room():
    for part, rooms in zip(stage.box().training, stage.box().rooms, strict=True):
        assert {i for members in rooms.members for i in members} == set(range(len(part)))
        for number, point in enumerate(part):
            assert number in rooms.members[rooms.cells.locate(features(point))]


def test_one_material_makes_one_cell_without_error():
    box = material_box([stage.winding(np.zeros(3))], stage.wound().mesh.regions)
    alone = reduce_harmonic(stage.wound(), stage.space(), box, stage.TOP_HZ)
    assert len(alone.cells) == 1
    assert alone.error < 1e-9


@pytest.mark.parametrize(("most", "met"), [(1, False), (60, True)])
def test_what_a_limit_on_snapshots_leaves_is_told(most, met):
    box = material_box([stage.winding(np.zeros(3)), *stage.draws(16, 1)], stage.wound().mesh.regions, most=1)
    found = reduce_harmonic(stage.wound(), stage.space(), box, stage.TOP_HZ, most=most)
    assert (found.error <= 3e-4) == met
    assert not found.cells[0].basis.flags.writeable
