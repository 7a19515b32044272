"""Constants, ties and joint priors behind one vector."""

import pickle

import numpy as np
import pytest

from statorhom.errors import IdentificationError
from statorhom.identify.parameters.parameter_space import Parameter, ParameterSpace, Tie
from statorhom.identify.parameters.prior_block import PriorBlock

E_P = Parameter("E_p_pa", 1.9e11, 1.5e11, 2.05e11, 1e11, 3e11)
E_Z = Parameter("E_z_pa", 9.5e10, 2e10, 1.5e11, 1e9, 3e11)
NU = Parameter("nu", 0.3, 0.2, 0.4, 0.0, 0.49, "linear")
G = Parameter.constant("G_pa", 3e10)


def test_values_of_free_fixed_and_logarithmic_constants():
    space = ParameterSpace((E_P, G, NU))
    assert space.coordinates == ("E_p_pa", "nu")
    assert space.values(np.zeros(2)) == pytest.approx({"E_p_pa": 1.9e11, "G_pa": 3e10, "nu": 0.3})
    x = space.internal({"E_p_pa": 1.7e11, "nu": 0.25, "G_pa": 1.0})
    assert space.values(x) == pytest.approx({"E_p_pa": 1.7e11, "G_pa": 3e10, "nu": 0.25})


def test_limits_hold_in_internal_coordinates_and_clip_given_values():
    space = ParameterSpace((E_P, NU))
    np.testing.assert_allclose(space.physical(space.bounds.lower), [1e11, 0.0], rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(space.physical(space.bounds.upper), [3e11, 0.49], rtol=1e-9)
    np.testing.assert_allclose(
        space.internal({"E_p_pa": 9e11, "nu": -1.0}), [space.bounds.upper[0], space.bounds.lower[1]]
    )


def test_many_points_at_once():
    space = ParameterSpace((E_P, G, E_Z), (Tie(("E_p_pa", "E_z_pa"), "proportional"),))
    points = np.linspace(-1, 1, 5)[:, None]
    together = space.physical(points)
    np.testing.assert_array_equal(together, [space.physical(x) for x in points])


def test_equal_and_proportional_ties_are_driven_by_one_coordinate():
    equal = ParameterSpace((E_P, E_Z), (Tie(("E_p_pa", "E_z_pa")),))
    ratio = ParameterSpace((E_P, E_Z), (Tie(("E_p_pa", "E_z_pa"), "proportional"),))
    for space, factor in ((equal, 1.0), (ratio, 0.5)):
        assert space.coordinates == ("E_p_pa",)
        first, second = space.physical(np.array([-0.7]))
        assert second == pytest.approx(factor * first)
        assert list(space.owners) == [0, 0]


def test_a_tie_respects_the_limits_of_its_followers():
    narrow = Parameter("E_z_pa", 9.5e10, 8e10, 1.2e11, 6e10, 1.25e11)
    space = ParameterSpace((E_P, narrow), (Tie(("E_p_pa", "E_z_pa"), "proportional"),))
    assert space.physical(space.bounds.upper) == pytest.approx([2.5e11, 1.25e11])
    assert space.physical(space.bounds.lower) == pytest.approx([1.2e11, 6e10])


def test_physical_jacobian_matches_differences():
    space = ParameterSpace((E_P, G, NU, E_Z), (Tie(("E_p_pa", "E_z_pa"), "proportional"),))
    x, step = np.array([0.4, -1.1]), 1e-6
    columns = [(space.physical(x + step * e) - space.physical(x - step * e)) / (2 * step) for e in np.eye(2)]
    np.testing.assert_allclose(space.physical_jacobian(x), np.column_stack(columns), rtol=1e-6)


def test_the_prior_is_standard_normal_without_a_block():
    space = ParameterSpace((E_P, NU))
    x = np.array([0.3, -2.0])
    np.testing.assert_allclose(space.prior_residuals(x), x)


def test_a_block_gives_its_own_mean_and_covariance():
    block = PriorBlock(("nu", "E_p_pa"), [0.5, -1.0], [[0.04, 0.01], [0.01, 0.09]])
    space = ParameterSpace((E_P, E_Z, NU), blocks=(block,))
    np.testing.assert_allclose(space.prior_mean, [-1.0, 0.0, 0.5])
    np.testing.assert_allclose(space.prior_sd, [0.3, 1.0, 0.2])
    x = np.array([0.1, 0.7, 0.2])
    residuals = space.prior_residuals(x)
    away = x - space.prior_mean
    assert residuals @ residuals == pytest.approx(away @ np.linalg.solve(space.prior_covariance, away))
    draws = space.sample(40000, np.random.default_rng(1))
    # the hard limits lie beyond two standard deviations of every coordinate of the block
    np.testing.assert_allclose(np.cov(draws.T)[[0, 2]][:, [0, 2]], [[0.09, 0.01], [0.01, 0.04]], atol=0.004)


def test_samples_of_the_prior_have_its_quantiles_and_obey_the_limits():
    wide = Parameter("a", 1.0, 0.5, 4.0, 1e-6, 1e6)
    cut = Parameter("b", 1.0, 0.5, 4.0, 0.9, 1.2)
    space = ParameterSpace((wide, cut))
    values = space.physical(space.sample(20000, np.random.default_rng(2)))
    np.testing.assert_allclose(np.quantile(values[:, 0], [0.05, 0.5, 0.95]), [0.5, 1.0, 4.0], rtol=0.04)
    assert 0.9 <= values[:, 1].min() < values[:, 1].max() <= 1.2 + 1e-12


def test_a_space_survives_pickling():
    space = ParameterSpace((E_P, G, NU))
    x = np.array([0.2, 0.1])
    before = space.physical(x)
    np.testing.assert_array_equal(pickle.loads(pickle.dumps(space)).physical(x), before)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((1.0, 2.0, 3.0, 0.0, 9.0), "between low 2 and high 3"),
        ((1.0, 0.5, 3.0, 2.0, 9.0), "inside its limits 2 and 9"),
        ((1.0, -0.5, 3.0, 0.0, 9.0), "above 0"),
        ((float("nan"), 0.5, 3.0, 0.0, 9.0), "not finite"),
        ((1.0, float("nan"), 3.0, 0.0, 9.0), "between low nan"),
        ((1.0, 0.5, 3.0, 0.0, 9.0, "cubic"), "'log' or 'linear'"),
    ],
)
def test_contradictory_priors_are_refused_by_name(arguments, message):
    with pytest.raises(IdentificationError, match=message) as caught:
        Parameter("E_pa", *arguments)
    assert str(caught.value).startswith("E_pa: ")
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (((E_P, E_P),), "'E_p_pa' occurs twice"),
        (((E_P, G), (Tie(("E_p_pa", "G_pa")),)), "'G_pa' is fixed as well"),
        (((E_P, G), (Tie(("E_p_pa", "E_q_pa")),)), "'E_q_pa' is unknown"),
        (((E_P, E_Z, NU), (Tie(("E_p_pa", "nu")), Tie(("E_z_pa", "nu")))), "'nu' occurs twice"),
        (((E_P, NU), (Tie(("E_p_pa", "nu")),)), "leave no room"),
        (((E_P, G), (), (PriorBlock(("G_pa",), [0.0], [[1.0]]),)), "'G_pa' is fixed"),
        (((E_P, E_Z), (Tie(("E_p_pa", "E_z_pa"), "opposite"),)), "'equal' or 'proportional'"),
    ],
)
def test_contradictory_spaces_are_refused(arguments, message):
    with pytest.raises(IdentificationError, match=message):
        ParameterSpace(*arguments)
