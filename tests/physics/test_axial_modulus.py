"""Another E_z of the sheets, against the material that has it."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from statorhom.errors import MaterialError
from statorhom.materials.transversely_isotropic import TransverselyIsotropic
from statorhom.model.affine import hooke_coefficients
from statorhom.physics.effects.stack_pressure_gradient import axial_modulus

SHEETS = TransverselyIsotropic(190e9, 60e9, 0.28, 0.3, 20e9)


@given(st.floats(0.02, 1.98))
def test_the_change_is_the_material_with_that_modulus(factor: float) -> None:
    entries, weight = axial_modulus(SHEETS.hooke(), lambda z: z)
    [times] = weight(np.array([factor - 1.0]))
    other = TransverselyIsotropic(190e9, factor * 60e9, 0.28, 0.3, 20e9)
    expected = hooke_coefficients(other.hooke()) - hooke_coefficients(SHEETS.hooke())
    np.testing.assert_allclose(times * entries, expected, rtol=1e-9, atol=1e-3)


def test_a_modulus_that_no_material_has_is_refused() -> None:
    stiff = TransverselyIsotropic(190e9, 150e9, 0.28, 0.55, 20e9)
    _, weight = axial_modulus(stiff.hooke(), lambda z: z)
    with pytest.raises(MaterialError, match="too high for the sheets"):
        weight(np.array([0.0, 0.9]))
