"""Intervals hold what they promise, and statuses say what the data did."""

import numpy as np
import pytest

from statorhom.identify.inference.intervals import posterior
from statorhom.identify.inference.optima import find_optima
from statorhom.identify.inference.polish import polish
from statorhom.identify.inference.problem import FunctionProblem
from statorhom.identify.parameters.parameter_space import Parameter, ParameterSpace, Tie


def parameter(name, scale="log", lower=None, upper=1e6):
    lower = {"log": 1e-6, "linear": -1e6}[scale] if lower is None else lower
    return Parameter(name, 1.0, 0.6, 1.9, lower, upper, scale)


def fit(space, residuals, derivative=None):
    return posterior([polish(FunctionProblem(space, residuals, derivative), space.start)], space)


def test_90_percent_intervals_cover_90_percent():
    rng = np.random.default_rng(2026)
    space = ParameterSpace((parameter("a"), parameter("b", "linear"), parameter("c")))
    matrix = np.array([[4.0, 1.0, 0.0], [1.0, -2.0, 0.2], [0.3, 1.0, 0.4], [2.0, 2.0, -0.5]])
    hits = np.zeros(3)
    for _ in range(200):
        truth = rng.standard_normal(3)
        data = matrix @ truth + rng.standard_normal(4)
        estimates = fit(space, lambda x, data=data: matrix @ x - data, lambda _: matrix).estimates()
        values = space.values(truth)
        hits += [e.low90 <= values[e.name] <= e.high90 for e in estimates.values()]
    np.testing.assert_allclose(hits / 200, 0.9, atol=0.04)


def test_quantiles_are_those_of_the_exact_posterior():
    space = ParameterSpace((parameter("a"),))
    estimate = fit(space, lambda x: 7.0 * (x - 0.3)).estimates()["a"]
    mean, sd = 49 * 0.3 / 50, 50**-0.5
    expected = space.physical(np.array([[mean - 1.64485 * sd], [mean], [mean + 1.64485 * sd]]))[:, 0]
    np.testing.assert_allclose([estimate.low90, estimate.value, estimate.high90], expected, rtol=2e-3)
    assert estimate.spread_ratio == pytest.approx(sd, rel=0.01)


def test_statuses():
    space = ParameterSpace(
        (parameter("sharp"), parameter("blunt"), parameter("unseen"), Parameter.constant("held", 4.0))
    )
    estimates = fit(space, lambda x: np.array([100.0 * x[0], 8.0 * x[1]])).estimates()
    assert [e.status for e in estimates.values()] == [
        "identified",
        "prior_dominated",
        "prior_dominated",
        "fixed",
    ]
    # the data did determine `blunt`, only not to 3 %
    assert estimates["blunt"].spread_ratio < 1 / 3
    loose = fit(space, lambda x: np.array([100.0 * x[0], 8.0 * x[1]])).estimates(precision=0.2)
    assert loose["blunt"].status == "identified"
    assert estimates["held"].low90 == estimates["held"].high90 == 4.0


def test_a_narrow_prior_is_not_an_identification():
    narrow = ParameterSpace((Parameter("a", 1.0, 0.99, 1.01, 0.5, 2.0),))
    estimate = fit(narrow, lambda x: 0.1 * x).estimates()["a"]
    assert 0.5 * (estimate.high90 - estimate.low90) < 0.02
    assert estimate.status == "prior_dominated"


def test_a_value_pinned_by_a_hard_limit_is_not_identified_and_lies_in_its_interval():
    space = ParameterSpace((parameter("a", upper=1.5), parameter("b")))
    result = fit(space, lambda x: np.array([50.0 * (x[0] - 9.0), 90.0 * x[1]]))
    estimates = result.estimates()
    assert estimates["a"].spread_ratio < 1 / 3
    assert estimates["a"].status == "prior_dominated"
    assert estimates["a"].low90 <= estimates["a"].value <= estimates["a"].high90 <= 1.5 * (1 + 1e-12)
    assert estimates["b"].status == "identified"


def test_tied_constants_share_their_fate():
    space = ParameterSpace((parameter("a"), parameter("b"), parameter("c")), (Tie(("a", "c")),))
    estimates = fit(space, lambda x: np.array([100.0 * (x[0] - 0.5)])).estimates()
    assert estimates["a"].status == estimates["c"].status == "identified"
    assert (estimates["a"].low90, estimates["a"].high90) == (estimates["c"].low90, estimates["c"].high90)
    assert estimates["b"].status == "prior_dominated"


def test_two_equal_optima_share_the_probability():
    space = ParameterSpace((parameter("a"),))
    problem = FunctionProblem(space, lambda x: 40.0 * (x**2 - 1.0))
    result = posterior(find_optima(problem, seed=3, evaluations=800), space)
    np.testing.assert_allclose(result.weights, [0.5, 0.5], atol=1e-3)
    estimate = result.estimates()["a"]
    low, high = space.physical(np.array([[-1.0], [1.0]]))[:, 0]
    assert estimate.low90 == pytest.approx(low, rel=0.05)
    assert estimate.high90 == pytest.approx(high, rel=0.05)
    assert estimate.status == "prior_dominated"
    single = result.components[0].log_evidence
    assert result.log_evidence == pytest.approx(single + np.log(2.0), abs=1e-3)
    grid = np.linspace(-6, 6, 200001)
    integrand = np.exp(-0.5 * (40.0 * (grid**2 - 1.0)) ** 2 - 0.5 * grid**2) / np.sqrt(2 * np.pi)
    assert result.log_evidence == pytest.approx(np.log(integrand.sum() * (grid[1] - grid[0])), abs=0.01)


def test_two_steps_with_a_carried_prior_equal_one_step_with_all_data():
    parameters = (parameter("a"), parameter("b"))
    first = np.array([[5.0, 4.0]])
    second = np.array([[1.0, -2.0], [0.5, 0.1]])
    data = np.array([0.7, -0.2, 0.4])
    plain = ParameterSpace(parameters)
    early = fit(plain, lambda x: first @ x - data[:1])
    later = fit(ParameterSpace(parameters, blocks=(early.block(),)), lambda x: second @ x - data[1:])
    both = fit(plain, lambda x: np.vstack([first, second]) @ x - data)
    np.testing.assert_allclose(later.mean, both.mean, atol=0.01)
    np.testing.assert_allclose(later.covariance, both.covariance, rtol=0.03, atol=1e-3)


def test_draws_are_reproducible_and_cannot_be_changed():
    space = ParameterSpace((parameter("a"),))
    one, two = (fit(space, lambda x: 7.0 * (x - 0.3)) for _ in range(2))
    np.testing.assert_array_equal(one.draws, two.draws)
    np.testing.assert_allclose(one.physical_draws[:, 0], space.physical(one.draws)[:, 0])
    with pytest.raises(ValueError, match="read-only"):
        one.draws[0, 0] = 1.0
