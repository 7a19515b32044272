import numpy as np
from small_stators import MATERIALS, stator_mesh

from statorhom.model.affine import assemble, hooke_coefficients
from statorhom.model.broken.basis import symmetric_basis
from statorhom.model.broken.layers import radial_layers
from statorhom.model.broken.prepare import prepared
from statorhom.model.broken.solve import solve_broken
from statorhom.model.broken.variations import strip


def test_a_prepared_basis_is_small_and_serves_other_places_and_strengths():
    half = stator_mesh(6)
    core = radial_layers(half, "lamination", hooke_coefficients(MATERIALS["lamination"].hooke), 2)
    pitch = np.pi / 3

    def change(offset, ratio):
        return [strip(core, offset * pitch, width=0.15, depth=0.009, ratio=ratio)]

    plain = symmetric_basis(assemble(half), MATERIALS, 9000.0)
    trainings = [change(offset, 0.3) for offset in (0.0, 0.3)]
    ready = prepared(plain, trainings)
    large = plain
    for changes in trainings:
        large = solve_broken(large, changes, tolerance=5e-4).basis
    assert len(plain.values) < len(ready.values) < len(large.values)
    for place, ratio in ((2.0, 0.3), (-4.3, 0.4)):
        found = solve_broken(ready, change(place, ratio), tolerance=None)
        assert np.all(found.errors < 1e-3)
        # a basis that was enriched for this place and strength alone stands for the truth
        exact = solve_broken(plain, change(place, ratio), tolerance=1e-4)
        assert len(exact) == len(found)
        np.testing.assert_allclose(found.frequencies_hz, exact.frequencies_hz, rtol=1e-3)
