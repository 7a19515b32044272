"""Loss factors of regions from those of modes."""

import numpy as np
import pytest

from statorhom.errors import IdentificationError
from statorhom.identify.results.damping import LossPrior, fit_loss_factors
from statorhom.results.schema import Interval

REGIONS = ("lamination", "winding")
SHARES = np.array([[0.9, 0.1], [0.7, 0.3], [0.5, 0.5], [0.95, 0.05], [0.3, 0.7]])
TRUTH = np.array([0.004, 0.03])


def test_exact_data_give_the_exact_factors_and_predict_unmeasured_modes():
    loss = [*(SHARES[:4] @ TRUTH), None]
    found = fit_loss_factors(REGIONS, SHARES, loss)
    assert [found.regions[r].value for r in REGIONS] == pytest.approx(TRUTH)
    np.testing.assert_allclose(found.predicted, SHARES @ TRUTH)
    assert found.unexplained == 0.0
    for region, truth in zip(REGIONS, TRUTH, strict=True):
        low, high = found.regions[region].ci90
        assert low < truth < high


def test_the_interval_of_one_region_is_that_of_a_weighted_mean():
    found = fit_loss_factors(("lamination",), np.ones((4, 1)), [0.01] * 4, relative_sd=0.1)
    low, high = found.regions["lamination"].ci90
    half = 1.645 * 0.1 / np.sqrt(4)
    assert (low, high) == pytest.approx((0.01 * (1 - half), 0.01 * (1 + half)), rel=3e-3)


@pytest.mark.parametrize("given_sd", [0.15, 0.05])
def test_intervals_cover_the_truth(given_sd):
    """With the stated spread, and with one of 15 % that the tables understate as 5 %."""
    rng = np.random.default_rng(11)
    shares = rng.dirichlet([2.0, 1.0], 12)
    hits, repeats = np.zeros(2), 80
    for _ in range(repeats):
        loss = shares @ TRUTH * (1 + 0.15 * rng.standard_normal(12))
        found = fit_loss_factors(REGIONS, shares, loss.tolist(), relative_sd=given_sd)
        hits += [
            found.regions[r].ci90[0] <= t <= found.regions[r].ci90[1]
            for r, t in zip(REGIONS, TRUTH, strict=True)
        ]
    assert np.all(hits / repeats > 0.82), hits / repeats
    assert given_sd == 0.05 or np.all(hits / repeats < 0.98)


def test_an_outlier_pulls_less_than_its_share():
    shares = np.tile([[0.8, 0.2], [0.4, 0.6]], (5, 1))
    loss = shares @ TRUTH
    loss[0] *= 6
    found = fit_loss_factors(REGIONS, shares, loss.tolist())
    plain = np.linalg.lstsq(shares, loss, rcond=None)[0]
    for k, region in enumerate(REGIONS):
        assert abs(found.regions[region].value - TRUTH[k]) < 0.25 * TRUTH[k]
    assert abs(plain[0] - TRUTH[0]) > 1.5 * TRUTH[0]


def test_scatter_beyond_the_measurement_s_is_told():
    rng = np.random.default_rng(5)
    shares = rng.dirichlet([1.0, 1.0], 60)
    loss = shares @ TRUTH * (1 + np.clip(0.3 * rng.standard_normal(60), -0.9, 0.9))
    assert fit_loss_factors(REGIONS, shares, loss.tolist()).unexplained == pytest.approx(0.26, abs=0.07)
    assert fit_loss_factors(REGIONS, shares, loss.tolist(), relative_sd=0.4).unexplained == 0.0


def test_a_factor_that_the_data_would_make_negative_is_zero_with_a_one_sided_interval():
    loss = SHARES @ np.array([0.01, -0.003])
    found = fit_loss_factors(REGIONS, SHARES[:4], loss[:4].tolist())
    winding = found.regions["winding"]
    assert winding.value == 0.0
    assert winding.ci90[0] == 0.0
    assert 0.0 < winding.ci90[1] < 0.02


def test_a_region_that_no_mode_reaches_has_none_unless_an_earlier_step_tells():
    shares = np.array([[0.99, 0.01, 0.0], [0.985, 0.015, 0.0]])
    regions = (*REGIONS, "frame")
    found = fit_loss_factors(regions, shares, [0.004, 0.0041])
    assert found.regions["winding"] is None
    assert found.regions["frame"] is None
    assert found.regions["lamination"].value == pytest.approx(0.00405 / 0.9875, rel=0.01)
    told = fit_loss_factors(regions, shares, [0.004, 0.0041], priors={"frame": LossPrior(0.02, 0.002)})
    assert told.regions["frame"].value == pytest.approx(0.02)
    assert told.regions["frame"].ci90 == pytest.approx((0.02 - 1.645 * 0.002, 0.02 + 1.645 * 0.002), rel=0.01)


def test_an_earlier_step_counts_as_its_interval_says():
    loss = (SHARES @ TRUTH).tolist()
    earlier = LossPrior.of(Interval(value=0.008, ci90=(0.008 - 1.645e-6, 0.008 + 1.645e-6)))
    assert earlier.sd == pytest.approx(8e-6)  # nothing is known to less than a thousandth
    sharp = fit_loss_factors(REGIONS, SHARES, loss, priors={"lamination": earlier})
    vague = fit_loss_factors(REGIONS, SHARES, loss, priors={"lamination": LossPrior(0.008, 1.0)})
    assert sharp.regions["lamination"].value == pytest.approx(0.008, rel=1e-2)
    assert vague.regions["lamination"].value == pytest.approx(TRUTH[0], rel=1e-3)
    assert sharp.unexplained > 0.0


def test_without_any_damping_nothing_is_known():
    found = fit_loss_factors(REGIONS, SHARES, [None] * 5)
    assert found.regions == {"lamination": None, "winding": None}
    np.testing.assert_array_equal(found.predicted, 0.0)


def test_shares_that_never_differ_leave_both_factors_wide():
    found = fit_loss_factors(REGIONS, np.tile([0.5, 0.5], (6, 1)), [0.02] * 6)
    for region in REGIONS:
        low, high = found.regions[region].ci90
        assert low < 0.004
        assert high > 0.03


@pytest.mark.parametrize("value", [-0.01, 0.0, float("nan"), float("inf")])
def test_impossible_loss_factors_are_refused(value):
    with pytest.raises(IdentificationError, match="loss factors must be positive"):
        fit_loss_factors(REGIONS, SHARES, [0.01, 0.01, 0.01, 0.01, value])
