"""The parameter space of a step."""

import numpy as np
import pytest
import synthetic_stage as stage

from statorhom.errors import IdentificationError
from statorhom.identify.fits.priors import Carried, stage_space
from statorhom.identify.parameters.parameter_space import Parameter, Tie
from statorhom.identify.parameters.prior_block import PriorBlock
from statorhom.identify.stages.stage_materials import RegionModel, StageMaterials
from statorhom.materials.density import RegionDensity
from statorhom.study.stages import StageKeys

WOUND = StageMaterials(
    (
        RegionModel("lamination", "isotropic", "lamination"),
        RegionModel("winding", "isotropic", "winding"),
        RegionModel("overhang", "transversely_isotropic", "overhang"),
    )
)
EARLIER = Carried(
    (
        Parameter("lamination.E_pa", 190e9, 150e9, 210e9, 50e9, 300e9),
        Parameter("lamination.nu", 0.3, 0.25, 0.35, 0.0, 0.49, "linear"),
        Parameter("lamination.density_kg_m3", 7700.0, 7690.0, 7710.0, 7600.0, 7800.0, "linear"),
        Parameter("winding.E_pa", 1e9, 0.5e9, 2e9, 0.1e9, 9e9),
    ),
    (Tie(("winding.E_pa", "winding.nu")),),
    PriorBlock(("lamination.E_pa", "lamination.nu"), [0.5, -0.2], [[0.04, 0.01], [0.01, 0.9]]),
)
DENSITIES = {"winding": RegionDensity("wound", "winding", 1.3, 4e-4, 3100.0, 20.0)}


def wound(**identify):
    keys = StageKeys.model_validate({"name": "wound", "kind": "wound", "mass_kg": 4.4, "identify": identify})
    return stage_space(
        keys, WOUND, frozenset({"winding", "overhang"}), DENSITIES, EARLIER.without("winding"), {}
    )


def by_name(space):
    return {parameter.name: parameter for parameter in space.parameters}


def test_earlier_constants_keep_their_posterior_and_new_ones_get_typical_priors():
    space = wound()
    names = by_name(space)
    assert names["lamination.E_pa"] == EARLIER.parameters[0]
    assert space.prior_mean[space.coordinates.index("lamination.E_pa")] == 0.5
    assert space.prior_covariance[0, 1] == pytest.approx(0.01)
    assert 1e8 < names["winding.E_pa"].median < 1e11
    assert names["mesh"].median == 0.0
    assert space.names[-1] == "mesh"


def test_the_density_is_known_as_well_as_the_scale_allows():
    space = wound()
    for source in ("winding", "overhang"):  # an own overhang weighs what the winding weighs
        density = by_name(space)[f"{source}.density_kg_m3"]
        assert density.median == 3100.0
        assert (density.high90 - density.low90) / 2 == pytest.approx(1.645 * 20.0, rel=1e-3)
        assert density.upper - density.median == pytest.approx(4 * 1.645 * 20.0, rel=1e-3)


def test_a_density_that_is_hardly_known_stays_positive():
    density = {"winding": RegionDensity("wound", "winding", 0.01, 4e-4, 25.0, 20.0)}
    space = stage_space(
        stage.keys(), StageMaterials(WOUND.regions[1:2]), frozenset({"winding"}), density, Carried(), {}
    )
    assert by_name(space)["winding.density_kg_m3"].lower > 0.0


def test_fixed_tied_and_given_constants():
    space = wound(
        fixed={"winding": {"nu": 0.34}},
        prior={"winding": {"E_pa": {"low": 1e9, "high": 4e9}}},
        tied={"overhang": [["nu_p", "nu_pz"]]},
    )
    names = by_name(space)
    assert names["winding.nu"].fixed
    assert names["winding.nu"].median == 0.34
    e = names["winding.E_pa"]
    assert (e.low90, e.median, e.high90) == pytest.approx((1e9, 2e9, 4e9))
    assert "winding.nu" not in space.coordinates
    assert space.ties[-1] == Tie(("overhang.nu_p", "overhang.nu_pz"))


def test_limits_give_way_to_a_prior_beyond_them():
    e = by_name(wound(prior={"winding": {"E_pa": {"low": 1e6, "high": 1e13}}}))["winding.E_pa"]
    assert e.lower <= 1e6
    assert e.upper >= 1e13
    nu = by_name(wound(prior={"winding": {"nu": {"low": 0.2, "high": 0.4}}}))["winding.nu"]
    assert nu.median == pytest.approx(0.3)


def test_a_modulus_that_may_be_negative_is_refused():
    with pytest.raises(IdentificationError, match=r"prior\.winding\.E_pa: low = -1 must be positive"):
        wound(prior={"winding": {"E_pa": {"low": -1.0, "high": 1e9}}})


def test_a_region_that_is_identified_anew_leaves_no_trace():
    left = EARLIER.without("lamination")
    assert [p.name for p in left.parameters] == ["winding.E_pa"]
    assert left.ties == EARLIER.ties
    assert left.block is None
    assert EARLIER.without("winding").ties == ()
    half = Carried(EARLIER.parameters, (), EARLIER.block).without("winding")
    assert half.block.names == EARLIER.block.names
    np.testing.assert_array_equal(half.block.covariance, EARLIER.block.covariance)
    # a region whose name only begins the same stays
    assert EARLIER.without("lam").parameters == EARLIER.parameters


def test_results_keep_what_is_carried():
    again = Carried.from_state(EARLIER.state())
    assert again.parameters == EARLIER.parameters
    assert again.ties == EARLIER.ties
    np.testing.assert_array_equal(again.block.mean, EARLIER.block.mean)
    np.testing.assert_array_equal(again.block.covariance, EARLIER.block.covariance)
    assert Carried.from_state(None) == Carried()
    fixed = Carried((Parameter.constant("lamination.nu", 0.3),))
    assert Carried.from_state(fixed.state()).parameters == fixed.parameters
