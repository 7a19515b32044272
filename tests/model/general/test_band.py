import numpy as np
import pytest
from boxes import box_mesh
from scipy.linalg import eigh
from small_stators import ORTHOTROPIC

from statorhom.model.affine import Material
from statorhom.model.back_ends.superlu import superlu
from statorhom.model.frames import cartesian
from statorhom.model.general.band import GeneralModes, band_modes, shifted, with_missed
from statorhom.model.general.general_model import general_model

MATERIALS = {"box": Material(ORTHOTROPIC.hooke(), 7810.5)}
TOP_HZ = 4e4


@pytest.fixture(scope="module")
def pair():
    body = general_model(box_mesh((0.12, 0.05, 0.02), (4, 2, 1)), cartesian)
    return body.stiffness_matrix(MATERIALS), body.mass_matrix(MATERIALS)


@pytest.fixture(scope="module")
def exact(pair):
    values = eigh(pair[0].toarray(), pair[1].toarray(), eigvals_only=True)
    return values[values <= (2 * np.pi * TOP_HZ) ** 2]


@pytest.mark.parametrize("expected", [1, 10, 32])
def test_all_modes_of_the_band_and_no_other(pair, exact, expected):
    modes = band_modes(*pair, TOP_HZ, superlu, expected)
    assert len(exact) > 12
    np.testing.assert_allclose(modes.eigenvalues[6:], exact[6:], rtol=1e-9)
    assert np.all(np.abs(modes.eigenvalues[:6]) < 1e-8 * exact[6])


@pytest.mark.parametrize("missing", [[0], [8], [6, 9, 12], list(range(5, 13))])
def test_modes_that_an_iteration_missed_are_found(pair, exact, missing):
    K, M = pair
    modes, solve = band_modes(K, M, TOP_HZ, superlu), superlu(shifted(K, M, TOP_HZ))
    left = GeneralModes(np.delete(modes.eigenvalues, missing), np.delete(modes.vectors, missing, axis=1))
    again = with_missed(K, M, TOP_HZ, left, solve)
    np.testing.assert_allclose(again.eigenvalues[6:], exact[6:], rtol=1e-8)
    v = again.vectors
    np.testing.assert_allclose(v.T @ (M @ v), np.eye(len(exact)), atol=1e-8)
    assert len(with_missed(K, M, TOP_HZ, modes, solve).eigenvalues) == len(exact)


def test_a_body_of_one_element_is_solved_whole():
    body = general_model(box_mesh((0.1, 0.1, 0.1), (1, 1, 1)), cartesian)
    K, M = body.stiffness_matrix(MATERIALS), body.mass_matrix(MATERIALS)
    assert len(band_modes(K, M, 1e9, superlu).eigenvalues) == 60


def test_modes_cannot_be_changed(pair):
    modes = band_modes(*pair, TOP_HZ, superlu)
    for array in (modes.eigenvalues, modes.vectors):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0.0
