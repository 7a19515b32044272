"""The radial order of a shape over the core's height."""

import numpy as np
import pytest
from small_stators import MATERIALS, ring_mesh, stator_mesh

from statorhom.model.affine import assemble
from statorhom.model.free_modes import solve_free
from statorhom.model.radial_profile import PLANES, node_planes, radial_profile


def test_planes_span_the_core():
    mesh = stator_mesh(6, ("stack", "wound"))
    planes = radial_profile(mesh).planes
    assert len(planes) == PLANES
    assert 0 < planes[0] < 0.05 * mesh.length
    assert 0.95 * mesh.length < planes[-1] < mesh.length


@pytest.mark.parametrize("order", [1, 2, 3])
def test_profiles_of_a_ring_are_even_or_odd_and_as_large_as_the_surface_s_motion(order):
    model = assemble(ring_mesh(120.0, 100.0, 60.0, radial=1, axial=3, sectors=6, tangential=2))
    modes = solve_free(model, MATERIALS, 12000.0, (order,))
    seen = 0
    for mode in modes.modes:
        profile = modes.profiles[mode.problem][:, mode.column]
        parity = {"even": 1.0, "odd": -1.0}[modes.harmonics[mode.problem].axial]
        np.testing.assert_allclose(profile, parity * profile[::-1], atol=1e-6 * (1 + np.abs(profile).max()))
        if mode.axial is not None:
            assert mode.axial % 2 == (0 if parity > 0 else 1)
            seen += 1
    assert seen >= 1


def test_node_planes_count_sign_changes_and_pass_over_what_is_near_zero():
    profiles = np.array(
        [
            [1.0, 1.0, 1.0, 0.0],
            [0.05, 0.5, -0.05, 0.0],
            [-0.04, -0.5, 0.9, 0.0],
            [0.9, -1.0, 1.0, 0.0],
            [1.0, 1.0, -1.0, 0.0],
        ]
    )
    np.testing.assert_array_equal(node_planes(profiles), [0, 2, 1, 0])
    np.testing.assert_array_equal(node_planes(-profiles), [0, 2, 1, 0])
