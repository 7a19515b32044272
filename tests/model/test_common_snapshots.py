"""Modes of all harmonics at some materials of a cell."""

import numpy as np
import pytest
import wound_box as stage

from statorhom.model import basis_greedy
from statorhom.model.common_snapshots import common_snapshots
from statorhom.model.harmonic import all_orders, harmonic_spaces
from statorhom.model.material_span import material_point
from statorhom.model.reduced import material_box, reduce_harmonic


def small_box():
    return material_box([stage.winding(np.zeros(3)), *stage.draws(24, 3)], stage.wound().mesh.regions, most=1)


def snapshots(spaces, count):
    box = small_box()
    return common_snapshots(stage.wound(), spaces, box.training[0], box.span.regions, stage.TOP_HZ, count)


def test_they_are_the_modes_of_every_harmonic_and_the_next_one():
    mesh = stage.wound().mesh
    spaces = [s for order in all_orders(mesh.slots) for s in harmonic_spaces(mesh, order)]
    found = snapshots(spaces, 3)
    box = small_box()
    materials = [stage.winding(np.zeros(3)), *stage.draws(24, 3)]
    by_hooke = {material_point(m, mesh.regions).hooke.tobytes(): m for m in materials}
    assert sum(len(known) for known in found) > len(spaces)
    for space, known in zip(spaces, found, strict=True):
        for number, (values, vectors) in known.items():
            point = box.training[0][number]
            at = by_hooke[point.hooke.tobytes()]
            exact, _ = stage.full_modes(at, space)
            assert len(values) == len(exact) + 1
            assert values[-1] > (2 * np.pi * stage.TOP_HZ) ** 2
            moving = exact > 1e4
            np.testing.assert_allclose(values[:-1][moving], exact[moving], rtol=1e-8)
            mass = vectors.T @ (space.project(stage.wound().mass_matrix(at)) @ vectors)
            np.testing.assert_allclose(mass, np.eye(len(values)), atol=1e-7)


def test_the_materials_begin_with_the_reference_and_are_as_many_as_asked_for():
    (known,) = snapshots([stage.space()], 4)
    assert 0 in known
    # of one of them the next mode lies too far above the band
    assert len(known) == 3


def test_no_more_materials_are_solved_than_there_are():
    (known,) = snapshots([stage.space()], 1000)
    assert len(known) <= len(small_box().training[0])


@pytest.mark.parametrize("count", [1, 6])
def test_a_basis_that_begins_with_them_meets_its_tolerance_with_fewer_solutions_of_its_own(
    count, monkeypatch
):
    solved = []
    modes_below = basis_greedy.modes_below

    def counted(*args, **named):
        solved.append(1)
        return modes_below(*args, **named)

    monkeypatch.setattr(basis_greedy, "modes_below", counted)
    box = small_box()
    alone = reduce_harmonic(stage.wound(), stage.space(), box, stage.TOP_HZ, stage.TOLERANCE)
    without, solved[:] = len(solved), []
    known = [snapshots([stage.space()], count)[0]]
    begun = reduce_harmonic(stage.wound(), stage.space(), box, stage.TOP_HZ, stage.TOLERANCE, known=known)
    assert max(alone.error, begun.error) <= stage.TOLERANCE
    assert len(solved) < without
    assert len(solved) <= without - 2 or count == 1
