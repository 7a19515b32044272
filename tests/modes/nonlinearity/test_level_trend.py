import numpy as np
import pytest

from statorhom.errors import IdentificationError
from statorhom.modes.nonlinearity.level_trend import level_trend

LEVELS = np.array([5.0, 10.0, 20.0, 50.0])


@pytest.mark.parametrize("known", [True, False])
@pytest.mark.parametrize("tests", [3, 4])
def test_no_trend_gives_no_hint(known, tests):
    rng = np.random.default_rng(11)
    f_sd, eta_sd = np.full(tests, 0.5), np.full(tests, 3e-4)
    p = []
    for _ in range(1000):
        f = 1000 + f_sd * rng.standard_normal(tests)
        eta = 0.01 + eta_sd * rng.standard_normal(tests)
        p.append(level_trend(LEVELS[:tests], f, eta, *((f_sd, eta_sd) if known else ())).p)
    assert np.mean(np.array(p) < 0.01) < 0.018


def test_friction_lowers_the_frequency_and_raises_the_loss():
    decades = np.log10(LEVELS / 5)
    f, eta = 1000 * np.exp(-0.01 * decades), 0.01 * np.exp(0.5 * decades)
    found = level_trend(LEVELS, f, eta, np.full(4, 1.0), np.full(4, 2e-4))
    assert found.frequency_per_decade == pytest.approx(-0.01)
    assert found.loss_per_decade == pytest.approx(0.5)
    assert found.p < 1e-6


def test_two_levels_need_standard_deviations():
    assert level_trend([5, 20], [1000, 990], [0.01, 0.02]).p is None
    assert level_trend([5, 20], [1000, 990], [0.01, 0.02], [1, 1], [1e-3, 1e-3]).p < 1e-6


def test_scatter_beyond_the_stated_deviations_widens_them():
    found = level_trend(LEVELS, [1000, 1010, 990, 1005], [0.01] * 4, np.full(4, 0.1), np.full(4, 1e-4))
    assert found.p > 0.05


@pytest.mark.parametrize("levels", [[5.0, 5.0], [5.0], [5.0, np.nan], [0.0, 1.0]])
def test_one_level_is_no_trend(levels):
    with pytest.raises(IdentificationError, match="force_level_n"):
        level_trend(levels, np.full(len(levels), 1000.0), np.full(len(levels), 0.01))
