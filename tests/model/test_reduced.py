"""Bases per cell of a box of materials."""

import numpy as np
import pytest
import wound_box as stage

from statorhom.model.material_span import material_point
from statorhom.model.reduced import material_box, reduce_harmonic


def test_every_material_is_trained_in_its_cell_and_around():
    training = [stage.winding(np.zeros(3)), *stage.draws(40, 3)]
    box = material_box(training, stage.wound().mesh.regions, most=5)
    assert len(box.training) == 5
    for materials in training:
        point = material_point(materials, stage.wound().mesh.regions)
        own = box.training[box.cells.locate(point)]
        assert any(np.array_equal(point.hooke, p.hooke) for p in own)
    for number, part in enumerate(box.training):
        assert len(part) >= 12
        assert box.cells.locate(part[0]) == number


def test_the_certified_error_is_below_the_tolerance_at_all_training_materials():
    assert 0.0 < stage.reduced().error <= stage.TOLERANCE
    assert max(c.basis.shape[1] for c in stage.reduced().cells) < 0.2 * stage.space().size


def test_bases_have_unit_mass_and_diagonal_stiffness_at_the_reference():
    for part, cell in zip(stage.box().training, stage.reduced().cells, strict=True):
        mass = np.tensordot(part[0].density, cell.mass, axes=1)
        np.testing.assert_allclose(mass, np.eye(len(mass)), atol=1e-8)
        stiffness = np.tensordot(stage.box().span.weights(part[0]), cell.stiffness, axes=1)
        np.testing.assert_allclose(
            stiffness, np.diag(np.diag(stiffness)), atol=1e-8 * np.abs(stiffness).max()
        )


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
