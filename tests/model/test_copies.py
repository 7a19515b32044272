"""Forces of changed pieces in all copies against their products harmonic by harmonic."""

from __future__ import annotations

from unittest.mock import Mock

import numpy as np
import pytest
from small_stators import MATERIALS, stator_mesh

from statorhom.model.affine import assemble, hooke_coefficients
from statorhom.model.broken import copies
from statorhom.model.broken.basis import SymmetricBasis, symmetric_basis
from statorhom.model.broken.copies import MovedCopies
from statorhom.model.broken.grams import GramCache, project
from statorhom.model.broken.pieces import Pieces, stiffness_pieces

STACK = {"lamination": MATERIALS["lamination"]}


@pytest.fixture(scope="module", params=[5, 6])
def basis(request: pytest.FixtureRequest) -> SymmetricBasis:
    """Of an odd and of an even number of slots."""
    return symmetric_basis(assemble(stator_mesh(request.param)), STACK, 6000.0, certified=False)


def core(basis: SymmetricBasis) -> Pieces:
    return stiffness_pieces(basis.mesh, {"lamination": hooke_coefficients(STACK["lamination"].hooke)})


def drawn(basis: SymmetricBasis, pieces: Pieces) -> tuple[np.ndarray, np.ndarray]:
    """Weights (e, 2 N) of three kinds of pieces and of some that stay, and two motions' coordinates."""
    rng = np.random.default_rng(1)
    kinds = np.vstack([rng.standard_normal((3, 2 * basis.mesh.slots)), np.zeros(2 * basis.mesh.slots)])
    return kinds[np.arange(len(pieces)) % 4], rng.standard_normal((len(basis.waves), 2))


def test_rows_take_the_work_that_products_say(basis: SymmetricBasis) -> None:
    pieces, waves = core(basis), basis.waves
    weights, coordinates = drawn(basis, pieces)
    found = waves.work(*MovedCopies(waves, coordinates).forces(pieces, weights))
    expected = project(GramCache(), pieces, weights, waves, waves) @ coordinates
    np.testing.assert_allclose(found, expected, atol=1e-10 * np.abs(expected).max())


def test_copies_move_as_their_phases_say(basis: SymmetricBasis) -> None:
    waves, dofs = basis.waves, np.arange(0, basis.waves.shapes.shape[0], 7)
    _, coordinates = drawn(basis, core(basis))
    turned = waves.phases[:, :, None] * waves.spread(coordinates)
    expected = np.empty((2 * waves.slots, len(dofs), 2))
    expected[0::2] = (waves.shapes[dofs] @ turned).real
    expected[1::2] = (np.conj(waves.shapes[dofs]) @ turned).real
    found = waves.in_copies(dofs, coordinates)
    np.testing.assert_allclose(found, expected, atol=1e-12 * np.abs(expected).max())


def test_pieces_that_all_stay_have_no_forces(basis: SymmetricBasis) -> None:
    pieces, waves = core(basis), basis.waves
    weights, coordinates = drawn(basis, pieces)
    dofs, forces = MovedCopies(waves, coordinates).forces(pieces, 0 * weights)
    assert len(dofs) == 0
    np.testing.assert_array_equal(waves.work(dofs, forces), np.zeros((len(waves), 2)))


@pytest.mark.parametrize(("room", "times"), [(copies.KEPT_BYTES, 3), (1, 6)])
def test_images_are_made_once_where_there_is_room(
    basis: SymmetricBasis, monkeypatch: pytest.MonkeyPatch, room: int, times: int
) -> None:
    monkeypatch.setattr(copies, "KEPT_BYTES", room)
    pieces = core(basis)
    weights, coordinates = drawn(basis, pieces)
    moved = MovedCopies(basis.waves, coordinates)
    made = Mock(wraps=moved._made)
    monkeypatch.setattr(MovedCopies, "_made", lambda _, own: made(own))
    _, first = moved.forces(pieces, weights)
    _, second = moved.forces(pieces, 2 * weights)
    assert made.call_count == times
    np.testing.assert_allclose(second, 2 * first)
