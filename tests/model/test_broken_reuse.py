"""What the solver of broken symmetry makes once and uses again gives what it gives anew."""

from __future__ import annotations

import gc
import weakref
from dataclasses import replace
from unittest.mock import Mock

import numpy as np
import pytest
from small_stators import MATERIALS, stator_mesh

from statorhom.model.affine import assemble, hooke_coefficients
from statorhom.model.broken.attachments import lump, springs
from statorhom.model.broken.basis import SymmetricBasis, symmetric_basis
from statorhom.model.broken.change import Attachment, Change
from statorhom.model.broken.pieces import stiffness_pieces
from statorhom.model.broken.solve import BrokenModes, solve_broken
from statorhom.model.broken.variations import wave
from statorhom.model.broken.waves import Waves
from statorhom.model.supports import support_on
from statorhom.model.surface import surface_points
from statorhom.study.supports import LineSupport

TOP = 6000.0
STACK = {"lamination": MATERIALS["lamination"]}


@pytest.fixture(scope="module")
def basis() -> SymmetricBasis:
    return symmetric_basis(assemble(stator_mesh(6)), STACK, TOP, certified=False)


def held(basis: SymmetricBasis, stiffness: float) -> Attachment:
    table = {"name": "l", "kind": "lines", "angles_deg": (40.0, 97.3), "declared": "elastic"}
    keys = LineSupport(**table, normal_stiffness_n_per_m2=stiffness, tangential_ratio=0.5)
    return springs(basis.mesh, support_on(basis.mesh, keys).points)


def solved(basis: SymmetricBasis, *changes: Change) -> BrokenModes:
    return solve_broken(basis, changes, tolerance=None)


def test_springs_at_known_points_give_the_same_as_new_ones(basis: SymmetricBasis) -> None:
    first, second = held(basis, 1e9), held(basis, 1e11)
    solved(basis, first)
    again = solved(basis, replace(first, stiffness=second.stiffness))
    assert again.coupled.statics.to_units is solved(basis, first).coupled.statics.to_units
    anew = solved(replace(basis), second)
    np.testing.assert_allclose(again.eigenvalues, anew.eigenvalues, rtol=1e-10)


def test_a_basis_that_nobody_holds_is_freed_at_once(basis: SymmetricBasis) -> None:
    """What it keeps for known places must not hold it: a diagnosis makes dozens of them, of 100 MB each."""
    own = replace(basis)
    assert len(solved(own, held(own, 1e10), lump(own.mesh, 1.0, 0.03, 0.1)).coupled.statics)
    gone = weakref.ref(own)
    gc.disable()
    try:
        del own
        assert gone() is None
    finally:
        gc.enable()


def test_pieces_beside_springs_at_known_points_are_projected_once(
    basis: SymmetricBasis, monkeypatch: pytest.MonkeyPatch
) -> None:
    core = stiffness_pieces(basis.mesh, {"lamination": hooke_coefficients(STACK["lamination"].hooke)})
    oval = wave(basis.mesh, core, 0.9, harmonic=4, amplitude=0.02, inner=0.05)
    first, second = held(basis, 1e9), held(basis, 1e11)
    solved(basis, first, oval)
    images = Mock(wraps=Waves.in_copies)
    monkeypatch.setattr(Waves, "in_copies", lambda *arguments: images(*arguments))
    again = solved(basis, replace(first, stiffness=second.stiffness), replace(oval, weights=2 * oval.weights))
    images.assert_not_called()
    anew = solved(replace(basis), second, replace(oval, weights=2 * oval.weights))
    np.testing.assert_allclose(again.eigenvalues, anew.eigenvalues, rtol=1e-10)
    images.assert_called()


def test_surface_motion_is_that_of_the_full_shapes(basis: SymmetricBasis) -> None:
    modes = solved(basis, held(basis, 1e10), lump(basis.mesh, 1.0, 0.03, 0.1))
    # both halves of several pitches
    points = surface_points(basis.mesh, np.array([0.1, 1.4, 2.9, -0.3]), np.array([0.01, 0.05, 0.02, 0.07]))
    expected = modes.shapes.motion(points)
    np.testing.assert_allclose(modes.motion(points), expected, atol=1e-9 * np.abs(expected).max())


def test_without_probes_errors_are_unknown(basis: SymmetricBasis) -> None:
    assert np.all(np.isnan(solved(basis, lump(basis.mesh, 1.0, 0.03, 0.1)).errors))
