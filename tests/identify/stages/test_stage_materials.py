"""From constants to the materials of regions."""

import numpy as np
import pytest

from statorhom.errors import MaterialError
from statorhom.identify.stages.stage_materials import RegionModel, StageMaterials
from statorhom.materials.isotropic import Isotropic
from statorhom.model.affine import hooke_coefficients

WOUND = StageMaterials(
    (
        RegionModel("lamination", "isotropic", "lamination"),
        RegionModel("winding", "transversely_isotropic", "winding"),
        RegionModel("overhang", "transversely_isotropic", "winding"),
    )
)
VALUES = {
    "lamination.E_pa": 190e9,
    "lamination.nu": 0.3,
    "lamination.density_kg_m3": 7800.0,
    "winding.E_p_pa": 2e9,
    "winding.E_z_pa": 11e9,
    "winding.nu_p": 0.33,
    "winding.nu_pz": 0.08,
    "winding.G_rz_pa": 0.7e9,
    "winding.density_kg_m3": 3100.0,
}


def test_regions_of_one_source_share_one_material():
    materials = WOUND.of(VALUES)
    assert materials["overhang"] is materials["winding"]
    np.testing.assert_allclose(materials["lamination"].hooke.matrix, Isotropic(190e9, 0.3).hooke().matrix)
    assert materials["lamination"].density == 7800.0
    assert WOUND.sources == {"lamination": "isotropic", "winding": "transversely_isotropic"}
    assert WOUND.names == tuple(VALUES)


def test_slopes_are_those_of_the_hooke_entries():
    slopes = WOUND.hooke_slopes(VALUES)
    assert slopes["overhang"] is slopes["winding"]
    for name, slope in (slopes["lamination"] | slopes["winding"]).items():
        region = name.split(".")[0]
        step = 1e-3 * VALUES[name]
        high, low = (
            hooke_coefficients(WOUND.of(VALUES | {name: VALUES[name] + s * step})[region].hooke)
            for s in (1, -1)
        )
        scale = np.abs(slope).max()
        np.testing.assert_allclose(slope, (high - low) / (2 * step), rtol=1e-4, atol=1e-4 * scale)
    # C11 of an isotropic material is proportional to E
    e = slopes["lamination"]["lamination.E_pa"][0]
    assert e * 190e9 == pytest.approx(Isotropic(190e9, 0.3).hooke().matrix[0, 0])


def test_the_slope_at_a_ratio_of_zero_exists():
    values = VALUES | {"winding.nu_pz": 0.0}
    slope = WOUND.hooke_slopes(values)["winding"]["winding.nu_pz"]
    assert np.all(np.isfinite(slope))
    assert slope[4] > 1e9  # C13 grows with the ratio


def test_log_frequency_slopes_add_up_over_the_regions_of_a_source():
    gradient = {r: (np.full(9, 1e-12 * k), -1e-4 * k) for k, r in enumerate(WOUND.of(VALUES), start=1)}
    slopes = WOUND.hooke_slopes(VALUES)
    found = WOUND.log_frequency_slopes(gradient, slopes)
    assert tuple(found) == WOUND.names
    assert found["winding.density_kg_m3"] == pytest.approx(-5e-4)
    expected = 5e-12 * slopes["winding"]["winding.E_p_pa"].sum()
    assert found["winding.E_p_pa"] == pytest.approx(expected)


def test_impossible_constants_are_an_error():
    with pytest.raises(MaterialError, match="nu"):
        WOUND.of(VALUES | {"lamination.nu": 0.6})
