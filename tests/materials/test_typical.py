import itertools

import pytest

from statorhom.errors import MaterialError
from statorhom.materials.analytic import analytic_lamination, analytic_winding
from statorhom.materials.symmetry import SYMMETRIES, constant_names
from statorhom.materials.transversely_isotropic import TransverselyIsotropic
from statorhom.materials.typical import prior_range

REGIONS = ("lamination", "winding", "overhang", "frame", "machine")
KINDS = ("stack", "wound", "impregnated", "framed", "machine")
TI = "transversely_isotropic"
SHEETS = analytic_lamination(0.5e-3, 5e-6)
WIRES = analytic_winding(3048.0, 3167.0, 0.25e-3, 0.275e-3)


def priors(region, kind, symmetry, analytic=None):
    return {name: prior_range(region, kind, symmetry, name, analytic) for name in constant_names(symmetry)}


@pytest.mark.parametrize(("region", "kind", "symmetry"), list(itertools.product(REGIONS, KINDS, SYMMETRIES)))
@pytest.mark.parametrize("analytic", [None, SHEETS, WIRES])
def test_every_prior_is_in_order_and_its_medians_make_a_material(region, kind, symmetry, analytic):
    found = priors(region, kind, symmetry, analytic)
    for prior in found.values():
        assert prior.lower_bound < prior.low90 < prior.median < prior.high90 < prior.upper_bound
    material = SYMMETRIES[symmetry](**{name: prior.median for name, prior in found.items()})
    material.hooke().check_positive_definite()


def test_moduli_are_logarithmic_and_poissons_ratios_linear():
    scales = {name: prior.scale for name, prior in priors("winding", "wound", "orthotropic").items()}
    assert {name for name, scale in scales.items() if scale == "linear"} == {"nu_rt", "nu_rz", "nu_tz"}


def test_without_an_analytic_value_the_median_is_the_middle():
    modulus = prior_range("lamination", "stack", TI, "E_z_pa")
    assert modulus.median**2 == pytest.approx(modulus.low90 * modulus.high90)
    ratio = prior_range("lamination", "stack", TI, "nu_p")
    assert ratio.median == pytest.approx((ratio.low90 + ratio.high90) / 2.0)


def test_an_analytic_value_moves_the_median_and_never_narrows_the_range():
    for region, kind, analytic in (("lamination", "stack", SHEETS), ("winding", "impregnated", WIRES)):
        plain, moved = priors(region, kind, TI), priors(region, kind, TI, analytic)
        for name, prior in moved.items():
            value = getattr(analytic, name)
            assert abs(prior.median - value) < abs(plain[name].median - value)
            assert prior.low90 <= min(value, plain[name].low90)
            assert prior.high90 >= max(value, plain[name].high90)


def test_the_median_moves_halfway():
    plain, moved = (prior_range("lamination", "stack", TI, "G_rz_pa", a) for a in (None, SHEETS))
    assert moved.median**2 == pytest.approx(plain.median * SHEETS.G_rz_pa)


def test_an_isotropic_region_takes_the_stiffness_in_the_plane():
    moved = prior_range("lamination", "stack", "isotropic", "E_pa", SHEETS)
    plain = prior_range("lamination", "stack", "isotropic", "E_pa")
    assert moved.median**2 == pytest.approx(plain.median * SHEETS.E_p_pa)


def test_a_poissons_ratio_across_wires_is_not_that_of_an_isotropic_winding():
    # ν_p of soft resin between wires may exceed ½, which no isotropic material has
    assert prior_range("winding", "impregnated", TI, "nu_p").upper_bound > 0.5
    assert prior_range("winding", "impregnated", "isotropic", "nu", WIRES) == prior_range(
        "winding", "impregnated", "isotropic", "nu"
    )


def test_an_analytic_value_beyond_the_limits_is_ignored():
    diamond = TransverselyIsotropic(1000e9, 1000e9, 0.1, 0.1, 400e9)
    assert priors("winding", "wound", TI, diamond)["E_p_pa"] == priors("winding", "wound", TI)["E_p_pa"]


def test_an_orthotropic_region_shares_the_ranges_of_its_directions():
    found = priors("lamination", "stack", "orthotropic")
    assert found["E_r_pa"] == found["E_t_pa"] == prior_range("lamination", "stack", TI, "E_p_pa")
    assert found["G_rz_pa"] == found["G_tz_pa"] == prior_range("lamination", "stack", TI, "G_rz_pa")
    assert found["nu_rz"] == found["nu_tz"] == prior_range("lamination", "stack", TI, "nu_pz")


@pytest.mark.parametrize(
    ("arguments", "reason"),
    [
        (("lamination", "stack", TI, "E_pa"), "has no constant 'E_pa': use one of E_p_pa, E_z_pa"),
        (("lamination", "stack", "cubic", "E_pa"), "unknown symmetry 'cubic'"),
        (("rotor", "stack", TI, "E_p_pa"), "region 'rotor'"),
    ],
)
def test_unknown_names_are_refused(arguments, reason):
    with pytest.raises(MaterialError, match=reason):
        prior_range(*arguments)
