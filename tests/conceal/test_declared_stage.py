"""Slopes of the declared stage by its constants."""

from __future__ import annotations

import numpy as np
import pytest

from statorhom.conceal.declared_stage import STEP, _hooke_slope
from statorhom.errors import MaterialError
from statorhom.materials.symmetry import SYMMETRIES

SHEETS = {"E_p_pa": 1e9, "E_z_pa": 8e9, "nu_p": 0.2, "nu_pz": 0.2, "G_rz_pa": 0.3e9}
SYMMETRY = "transversely_isotropic"


def edge() -> float:
    """nu_p at which there is no such material any more."""
    return 1 - 2 * SHEETS["nu_pz"] ** 2 * SHEETS["E_z_pa"] / SHEETS["E_p_pa"]


def test_a_modulus_has_the_slope_that_hookes_matrix_is_proportional_to() -> None:
    slope = _hooke_slope(SYMMETRY, SHEETS, "G_rz_pa", SHEETS["G_rz_pa"])
    assert np.sort(slope)[-2:] == pytest.approx(SHEETS["G_rz_pa"])


def test_at_the_edge_of_materials_the_slope_is_that_of_the_inside() -> None:
    close = {**SHEETS, "nu_p": edge() * (1 - 0.5 * STEP)}
    with pytest.raises(MaterialError):
        SYMMETRIES[SYMMETRY](**{**close, "nu_p": close["nu_p"] * (1 + STEP)})
    slope = _hooke_slope(SYMMETRY, close, "nu_p", close["nu_p"])
    assert np.all(np.isfinite(slope))
    # all that nu_p is part of rises towards the edge
    assert slope.max() > 0.0
