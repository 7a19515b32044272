"""A plate in its modal basis against whole meshes: lumps, springs, other dimensions, patches."""

from dataclasses import replace

import numpy as np
import pytest

from concealed_coupons import CLOTH, SIZE, Hidden, plate_frequencies, whole_plate
from statorhom.geometry.block import BlockGeometry
from statorhom.materials.orthotropic import Orthotropic
from statorhom.mesh.block import block_mesh
from statorhom.model.affine import Material, assemble
from statorhom.model.modal import point_residual
from statorhom.model.modal.acted_body import ActedBody
from statorhom.model.modal.modal_body import modal_body
from statorhom.physics.action import Attachment, Patch

TOP = 900.0
COARSE = 0.5  # of the mesh: both sides have the same
SMALL = (0.3, 0.2, 0.006)
MATERIALS = {"plate": CLOTH}


@pytest.fixture(scope="module")
def body() -> ActedBody:
    return made(SMALL)


def made(size: tuple[float, float, float]) -> ActedBody:
    model = assemble(block_mesh(BlockGeometry("plate", size, "test"), COARSE))
    return ActedBody(model, MATERIALS, modal_body(model, [MATERIALS], TOP))


def elastic(body: ActedBody, count: int, **changes) -> np.ndarray:
    values = body.modes(MATERIALS, count + 6, **changes).values
    return np.sqrt(values[6:]) / (2 * np.pi)


@pytest.mark.parametrize("place", [(0.21, 0.13), (0.3, 0.2)])
def test_a_lump_and_a_spring_move_the_modes_as_on_the_whole_mesh(
    body: ActedBody, place: tuple[float, float]
) -> None:
    hidden = Hidden(*place, mass_kg=0.017, stiffness=2e4)
    exact, [(x, y)] = plate_frequencies(TOP, [hidden], size=SMALL, factor=COARSE)
    bare, _ = plate_frequencies(TOP, size=SMALL, factor=COARSE)
    attached = [Attachment((x, y, SMALL[2]), 0.017, (0.0, 0.0, 2e4))]
    # the spring lifts one rigid body into the elastic ones' order
    values = np.sqrt(np.abs(body.modes(MATERIALS, 16, attached).values)) / (2 * np.pi)
    found = values[values > 20.0][: len(exact)]
    moved = np.abs(exact[: len(bare)] / bare[: len(exact)] - 1).max()
    assert moved > 0.01
    np.testing.assert_allclose(found, exact, rtol=1.5e-3)


def test_a_longer_body_is_the_mesh_with_other_hooke_entries(body: ActedBody) -> None:
    scale = (1.01, 0.99, 1.03)
    other = made((SMALL[0] * scale[0], SMALL[1] * scale[1], SMALL[2] * scale[2]))
    np.testing.assert_allclose(elastic(body, 5, scale=scale), elastic(other, 5), rtol=3e-4)
    assert np.abs(elastic(body, 5) / elastic(other, 5) - 1).min() > 5e-3


def test_a_patch_changes_stiffness_where_it_is(body: ActedBody) -> None:
    """First order: half the share of the strain energy that the patch holds, times what it changes by."""
    small = elastic(body, 4, patches=[Patch((0.08, 0.05), (0.04, 0.03), 1.02)])
    model = whole_plate(SMALL, COARSE)
    centres = model.mesh.nodes[model.mesh.elements[:, :8]].mean(axis=1)[:, :2]
    away = (centres - (0.08, 0.05)) / (0.04, 0.03)
    scale = 1 + 0.02 * np.exp(-0.5 * np.sum(away**2, axis=1))
    exact = model.solve(TOP, MATERIALS, element_scale=scale).frequencies_hz
    np.testing.assert_allclose(small, exact[6:10], rtol=2e-5)
    assert small[0] > 1.0005 * elastic(body, 4)[0]


def test_places_on_four_quarters_move_as_the_modes_are_mirrored(body: ActedBody) -> None:
    basis = body.basis
    x, y, z = SMALL
    at = [(0.07, 0.04, z), (x - 0.07, 0.04, z), (0.07, y - 0.04, z)]
    moved = basis.motion(np.array(at))[:, 2] @ basis.reference[:, 6:10]
    assert SIZE[:2] == SMALL[:2]
    np.testing.assert_allclose(np.abs(moved[1]), np.abs(moved[0]), rtol=1e-9)
    np.testing.assert_allclose(np.abs(moved[2]), np.abs(moved[0]), rtol=1e-9)
    # twisting comes first: odd at both planes
    assert moved[1, 0] == pytest.approx(-moved[0, 0])
    assert moved[2, 0] == pytest.approx(-moved[0, 0])


def test_a_body_of_like_materials_takes_its_local_shapes_from_the_other(body: ActedBody) -> None:
    softer = {"plate": Material(replace(CLOTH.hooke, matrix=0.97 * CLOTH.hooke.matrix), CLOTH.density)}
    own = ActedBody(body.model, softer, modal_body(body.model, [softer], TOP, counts=body.basis.counts))
    lump = [Attachment((0.3, 0.2, SMALL[2]), 0.017)]
    exact = own.modes(softer, 12, lump).values
    near = replace(own, like=body)
    assert len(near.residuals.plan) == len(body.residuals.plan)
    np.testing.assert_allclose(near.modes(softer, 12, lump).values[6:], exact[6:], rtol=1e-5)


def test_large_parts_have_their_local_shapes_at_fewer_points(
    body: ActedBody, monkeypatch: pytest.MonkeyPatch
) -> None:
    b = body.basis
    whole = len(body.residuals.plan)
    monkeypatch.setattr(point_residual, "WORK", 3 * len(b.mesh.nodes) * (whole // 2))
    monkeypatch.setattr(point_residual, "LEAST", 4)
    few = point_residual.point_residuals(body.model, MATERIALS, b.shapes, b.parities, b.highest_hz)
    assert len(few.plan) == whole // 2
    middle = np.array([[0.15, 0.1, SMALL[2]]])
    np.testing.assert_allclose(few.at(middle)[0], body.residuals.at(middle)[0], rtol=0.1)


def test_a_basis_that_knows_other_materials_has_their_modes_without_solving_them(body: ActedBody) -> None:
    soft = Orthotropic(35e9, 35e9, 11e9, 0.28, 0.3, 0.3, 11e9, 4.5e9, 4e9)
    other = {"plate": Material(soft.hooke(), CLOTH.density)}
    between = {"plate": Material(replace(soft, G_rt_pa=9e9).hooke(), CLOTH.density)}
    wide = ActedBody(body.model, MATERIALS, modal_body(body.model, [MATERIALS, other], TOP))
    for materials, allowed in ((other, 2e-4), (between, 1e-3)):
        exact = ActedBody(body.model, materials, modal_body(body.model, [materials], TOP))
        found, true = (b.modes(materials, 11).values[6:] for b in (wide, exact))
        np.testing.assert_allclose(np.sqrt(found), np.sqrt(true), rtol=allowed)
