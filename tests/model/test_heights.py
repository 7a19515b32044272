"""Stiffness by height against whole elements, and what a gradient tilts against more cells along the axis."""

from dataclasses import replace

import numpy as np
import pytest
from small_stators import MATERIALS, ring_mesh, stator_mesh

from statorhom.model.affine import assemble, hooke_coefficients
from statorhom.model.assembly import HOOKE_ENTRIES
from statorhom.model.broken.basis import symmetric_basis
from statorhom.model.broken.layers import radial_layers
from statorhom.model.broken.pieces import stiffness_pieces
from statorhom.model.broken.solve import solve_broken
from statorhom.model.broken.variations import gradient
from statorhom.model.surface import surface_points

TOP = 3000.0
CORE = hooke_coefficients(MATERIALS["lamination"].hooke)


def test_heights_make_up_their_elements():
    mesh = stator_mesh(6)
    whole = stiffness_pieces(mesh, {"lamination": CORE})
    parts = radial_layers(mesh, "lamination", CORE, 1, by_height=True)
    together = parts.pieces.matrices.reshape(len(whole), 3, 60, 60).sum(axis=1)
    np.testing.assert_allclose(together, whole.matrices, rtol=0, atol=1e-12 * np.abs(whole.matrices).max())
    z = parts.place.z.mean(axis=1).reshape(len(whole), 3)
    assert np.all(np.diff(z, axis=1) > 0) and z.min() > 0.0 and z.max() < mesh.length


def test_layers_by_height_make_up_their_layers():
    mesh = stator_mesh(6)
    whole = radial_layers(mesh, "lamination", CORE, 2)
    parts = radial_layers(mesh, "lamination", CORE, 2, by_height=True)
    together = parts.pieces.matrices.reshape(len(whole.pieces), 3, 60, 60).sum(axis=1)
    limit = 1e-12 * np.abs(together).max()
    np.testing.assert_allclose(together, whole.pieces.matrices, rtol=0, atol=limit)
    for name in ("angle", "radius"):
        own = getattr(parts.place, name).reshape(len(whole.pieces), 3, -1)
        np.testing.assert_array_equal(
            own, np.repeat(getattr(whole.place, name)[:, None], 3, axis=1).reshape(own.shape)
        )
    middle = parts.place.z.mean(axis=1).reshape(-1, 3)
    np.testing.assert_allclose(middle[:, 1], whole.place.z.mean(axis=1))


def tilt(axial: int, *, whole_cells: bool = False) -> float:
    """How far the radial motion of a long ring's lowest mode differs between its ends, where sheets shear unevenly."""
    mesh = ring_mesh(120.0, 96.0, 240.0, radial=1, axial=axial, sectors=8)
    model = assemble(mesh)
    sheared = np.where([entry in ((3, 3), (4, 4)) for entry in HOOKE_ENTRIES], CORE, 0.0)
    parts = radial_layers(mesh, "lamination", sheared, 1, by_height=True)
    middle = np.repeat(parts.place.z.mean(axis=1).reshape(-1, 3).mean(axis=1), 3)
    flat = replace(parts, place=replace(parts.place, z=np.stack([middle, middle], axis=-1)))
    used = flat if whole_cells else parts
    change = gradient(used, lambda z: 0.6 * (2 * z / mesh.length - 1.0))
    modes = solve_broken(symmetric_basis(model, MATERIALS, TOP), [change])
    angles = np.linspace(0.0, np.pi, 7)
    ends = [surface_points(mesh, angles, np.full(7, z)) for z in (0.0, mesh.length)]
    low, high = (np.linalg.norm(modes.motion(points)[:, 0, 0]) for points in ends)
    return float((high - low) / (high + low))


def test_a_gradient_tilts_shapes_alike_on_few_cells_and_on_many():
    """With the stiffness of its middle in all of a cell it would tilt them by a fifth less."""
    few, many = tilt(4), tilt(12)
    assert few == pytest.approx(many, rel=0.05)
    assert 0.7 < tilt(4, whole_cells=True) / many < 0.85
