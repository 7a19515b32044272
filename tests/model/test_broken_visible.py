"""A soft winding's own modes left out, against the whole basis."""

import numpy as np
import pytest
from small_stators import MATERIALS, stator_mesh

from statorhom.materials.transversely_isotropic import TransverselyIsotropic
from statorhom.model.affine import Material, assemble
from statorhom.model.broken.attachments import footed_lump, point_springs
from statorhom.model.broken.basis import symmetric_basis
from statorhom.model.broken.solve import solve_broken
from statorhom.model.broken.visible import visible

TOP = 5000.0
SOFT = Material(TransverselyIsotropic(1e8, 6e8, 0.33, 0.08, 3e7).hooke(), 3166.0)


@pytest.fixture(scope="module")
def basis():
    model = assemble(stator_mesh(12, ("stack", "wound")))
    materials = {r: MATERIALS["lamination"] if r == "lamination" else SOFT for r in model.mesh.regions}
    return symmetric_basis(model, materials, TOP, margin=1.25, certified=False)


def shown(basis, changes, count=6):
    """Frequencies of the modes that move the surface most."""
    modes = solve_broken(basis, changes, tolerance=None)
    held = modes.coupled.statics
    motion = held.answers.motion @ modes.coordinates
    most = np.argsort(-np.sum(motion**2, axis=0))[:count]
    return np.sort(modes.frequencies_hz[most])


def test_most_of_a_soft_windings_modes_are_left_out_and_no_mode_of_the_surface_moves(basis):
    reduced = visible(basis, least=0.01)
    assert len(reduced.values) < 0.8 * len(basis.values)
    mesh = basis.mesh
    for change in (
        footed_lump(mesh, 0.3, 0.03, 0.05, foot=0.01, height=0.007),
        point_springs(mesh, np.array([0.0, 2.0]), np.array([0.02, 0.05]), np.array([1e7, 1e6, 1e6])),
    ):
        assert shown(reduced, [change]) == pytest.approx(shown(basis, [change]), rel=2e-4)


def test_named_modes_stay_whatever_they_move(basis):
    problem = max(basis.problems, key=lambda p: len(p.values))
    named = [(problem.sector.space, np.sqrt(value) / (2 * np.pi)) for value in problem.values]
    kept = visible(basis, named, least=0.5)
    place = basis.problems.index(problem)
    assert np.array_equal(kept.problems[place].values, problem.values)
    assert len(kept.values) < len(basis.values)
