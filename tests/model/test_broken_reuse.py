"""What the solver of broken symmetry makes once and uses again gives what it gives anew."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from small_stators import MATERIALS, stator_mesh

from statorhom.model.affine import assemble
from statorhom.model.broken.attachments import lump, springs
from statorhom.model.broken.basis import SymmetricBasis, symmetric_basis
from statorhom.model.broken.change import Attachment
from statorhom.model.broken.solve import BrokenModes, solve_broken
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


def solved(basis: SymmetricBasis, *attachments: Attachment) -> BrokenModes:
    return solve_broken(basis, attachments, tolerance=None)


def test_springs_at_known_points_give_the_same_as_new_ones(basis: SymmetricBasis) -> None:
    first, second = held(basis, 1e9), held(basis, 1e11)
    solved(basis, first)
    again = solved(basis, replace(first, stiffness=second.stiffness))
    assert again.coupled.statics.loaded is solved(basis, first).coupled.statics.loaded
    anew = solved(replace(basis), second)
    np.testing.assert_allclose(again.eigenvalues, anew.eigenvalues, rtol=1e-10)


def test_surface_motion_is_that_of_the_full_shapes(basis: SymmetricBasis) -> None:
    modes = solved(basis, held(basis, 1e10), lump(basis.mesh, 1.0, 0.03, 0.1))
    # both halves of several pitches
    points = surface_points(basis.mesh, np.array([0.1, 1.4, 2.9, -0.3]), np.array([0.01, 0.05, 0.02, 0.07]))
    expected = modes.shapes.motion(points)
    np.testing.assert_allclose(modes.motion(points), expected, atol=1e-9 * np.abs(expected).max())


def test_without_probes_errors_are_unknown(basis: SymmetricBasis) -> None:
    assert np.all(np.isnan(solved(basis, lump(basis.mesh, 1.0, 0.03, 0.1)).errors))
