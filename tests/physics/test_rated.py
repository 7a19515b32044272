"""Modes of moduli that follow the frequency."""

from __future__ import annotations

import numpy as np
import pytest

from statorhom.model.stator_mode import StatorMode
from statorhom.physics.rated import self_consistent

RATES = np.log([400.0, 1000.0, 2500.0, 6000.0, 15000.0])


def mode(frequency_hz: float) -> StatorMode:
    return StatorMode(frequency_hz, 0, 1, "radial", 0.1, 1, 0, 0)


def tables(at_one_hertz: float, power: float, highest_hz: float = np.inf) -> list[dict]:
    """Of a mode whose frequency grows with a power of the rate, as far as the band reaches."""
    frequencies = at_one_hertz * np.exp(power * RATES)
    return [{(0, 1, 0): mode(f)} if f < highest_hz else {} for f in frequencies]


def test_a_mode_lies_where_the_moduli_at_its_frequency_put_it() -> None:
    found = self_consistent(RATES, tables(500.0, 0.25))
    assert np.exp(found[0, 1, 0]) == pytest.approx(500.0 ** (1 / 0.75))


@pytest.mark.parametrize("slope", [0.1, 0.5, 1.2])
def test_a_modulus_that_rises_by_decades_is_followed_to_a_fiftieth_of_a_percent(slope: float) -> None:
    def at(rate_hz: float) -> float:
        return 1500.0 * float(np.sqrt(0.5 + 0.5 * (1 + slope * np.log10(rate_hz / 1000.0))))

    exact = 2000.0
    for _ in range(60):
        exact = at(exact)
    found = self_consistent(RATES, [{(0, 1, 0): mode(at(rate))} for rate in np.exp(RATES)])
    assert np.exp(found[0, 1, 0]) == pytest.approx(exact, rel=2e-4)


def test_a_mode_that_stiffer_moduli_put_beyond_the_band_is_found_all_the_same() -> None:
    whole, cut = tables(500.0, 0.25), tables(500.0, 0.25, highest_hz=5000.0)
    assert not cut[-1] and cut[-2]
    assert self_consistent(RATES, cut) == self_consistent(RATES, whole)


def test_a_mode_that_the_tables_around_it_lack_is_not_told() -> None:
    assert self_consistent(RATES, tables(500.0, 0.25, highest_hz=3000.0)) == {}


def test_beyond_the_tables_moduli_are_those_of_the_nearest() -> None:
    assert np.exp(self_consistent(RATES, tables(50.0, 0.1))[0, 1, 0]) == pytest.approx(50.0 * 400.0**0.1)
    assert np.exp(self_consistent(RATES, tables(2e4, 0.1))[0, 1, 0]) == pytest.approx(2e4 * 15000.0**0.1)
