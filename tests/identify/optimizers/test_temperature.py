"""The cooling schedule from samples."""

import numpy as np
import pytest

from statorhom.identify.optimizers.temperature import end_temperature, start_temperature


@pytest.mark.parametrize("scale", [1e-9, 1.0, 1e9])
def test_the_start_temperature_accepts_the_share_that_was_asked_for(scale):
    rises = scale * np.random.default_rng(0).exponential(size=200)
    hot = start_temperature(rises, 0.5)
    assert np.mean(np.exp(-rises / hot)) == pytest.approx(0.5, abs=1e-6)
    # for exponentially distributed rises of mean m the share is T / (T + m)
    assert hot == pytest.approx(scale, rel=0.2)


def test_cooling_ends_below_the_noise_and_far_below_the_start():
    assert end_temperature(1e6) < 1.0
    assert end_temperature(1e-6) < 1e-8


def test_no_rise_at_all():
    assert start_temperature(np.empty(0), 0.5) > 0.0
