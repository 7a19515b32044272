import numpy as np
import pytest
from scipy.stats import norm

from statorhom.modes.nonlinearity.combined import combined_probability


@pytest.mark.parametrize("correlation", [0.0, 0.5, 0.9])
def test_false_alarms_stay_rare_also_with_correlated_frfs(correlation):
    rng = np.random.default_rng(1)
    common = rng.standard_normal((4000, 1))
    z = np.sqrt(correlation) * common + np.sqrt(1 - correlation) * rng.standard_normal((4000, 20))
    p = np.array([combined_probability(row) for row in norm.sf(z)])
    assert np.mean(p < 0.01) <= 0.015


def test_what_many_frfs_show_is_kept():
    assert combined_probability([1e-4] * 10 + [1.0] * 10) < 1e-3
    assert combined_probability([0.5, np.nan]) == pytest.approx(0.5)
    assert np.isnan(combined_probability([]))
