"""Estimators, coherence and random error against their theory, by Monte Carlo on spectra."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats

from statorhom.recordings.estimation.estimators import (
    coherence,
    frf,
    random_error,
    relative_sd_of_coherence,
    relative_sd_of_repeats,
    unbiased_coherence,
)
from statorhom.recordings.estimation.spectra import AveragedSpectra, average_spectra

TRUE = 2.0 - 1.5j
LINES = 4000  # independent repetitions of the experiment


def normal(rng: np.random.Generator, *shape: int) -> np.ndarray:
    """Complex noise of variance one."""
    return (rng.standard_normal(shape) + 1j * rng.standard_normal(shape)) / np.sqrt(2)


def measured(
    hits: int, of_response: float, of_force: float = 0.0, seed: int = 0
) -> tuple[np.ndarray, np.ndarray]:
    """Spectra of hits of force one, with noise of the response and of the force."""
    rng = np.random.default_rng(seed)
    force = np.ones((hits, LINES)) + of_force * normal(rng, hits, LINES)
    response = TRUE + of_response * normal(rng, hits, LINES)
    return force, response[:, np.newaxis]


def averaged(force: np.ndarray, response: np.ndarray) -> AveragedSpectra:
    return average_spectra(force, response, np.ones(response.shape[:2], dtype=bool))


def test_h1_is_unbiased_by_noise_of_the_response_and_h2_by_noise_of_the_force() -> None:
    noisy_response, noisy_force = averaged(*measured(200, 1.5)), averaged(*measured(200, 0.0, 0.6))
    both = averaged(*measured(200, 0.6 * abs(TRUE), 0.6))
    assert frf(noisy_response, "H1").mean() == pytest.approx(TRUE, rel=2e-3)
    assert frf(noisy_force, "H2").mean() == pytest.approx(TRUE, rel=2e-3)
    # the bias that each has elsewhere, and Hv where both are equally noisy
    assert np.abs(frf(noisy_response, "H2").mean() / TRUE) == pytest.approx(
        1 + 1.5**2 / abs(TRUE) ** 2, rel=0.01
    )
    assert np.abs(frf(noisy_force, "H1").mean() / TRUE) == pytest.approx(1 / (1 + 0.36), rel=0.01)
    assert frf(both, "Hv").mean() == pytest.approx(TRUE, rel=5e-3)


@pytest.mark.parametrize(("hits", "noise"), [(3, 0.5), (5, 2.0), (10, 4.0)])
def test_coherence_is_distributed_as_theory_says(hits: int, noise: float) -> None:
    estimated = coherence(averaged(*measured(hits, noise)))[0]
    # regression of the response on a known force: explained over residual variance is a noncentral F
    ratio = (hits - 1) * estimated / (1 - estimated)
    theory = stats.ncf(2, 2 * (hits - 1), 2 * hits * abs(TRUE) ** 2 / noise**2)
    assert stats.kstest(ratio, theory.cdf).pvalue > 0.01


@pytest.mark.parametrize("noise", [0.5, 2.0, 1e3])
@pytest.mark.parametrize("hits", [2, 4])
def test_coherence_of_few_averages_is_freed_of_its_bias(hits: int, noise: float) -> None:
    spectra = averaged(*measured(hits, noise))
    true = 1 / (1 + noise**2 / abs(TRUE) ** 2)
    estimated = coherence(spectra)
    assert estimated.mean() == pytest.approx(true + (1 - true) / hits, abs=0.04)
    inverted = (hits * (true + (1 - true) / hits) - 1) / (hits - 1)
    assert inverted == pytest.approx(true)
    corrected = unbiased_coherence(np.full((1, 1), true + (1 - true) / hits), spectra.averages)
    assert corrected[0, 0] == pytest.approx(true)


@pytest.mark.parametrize("hits", [3, 5, 20])
def test_random_error_is_that_of_monte_carlo(hits: int) -> None:
    noise = 0.4
    spectra = averaged(*measured(hits, noise))
    values = frf(spectra, "H1")[0]
    true = np.full((1, 1), 1 / (1 + noise**2 / abs(TRUE) ** 2))
    assert np.abs(values).std() / abs(TRUE) == pytest.approx(
        random_error(true, spectra.averages)[0, 0], rel=0.05
    )
    scatter = np.sqrt(np.mean(np.abs(values - TRUE) ** 2)) / abs(TRUE)
    claimed = np.sqrt(np.mean(relative_sd_of_coherence(spectra) ** 2))
    assert claimed == pytest.approx(scatter, rel=0.06)


@pytest.mark.parametrize("estimator", ["H1", "H2", "Hv"])
@pytest.mark.parametrize("hits", [3, 8])
def test_spread_of_repeats_is_that_of_monte_carlo(hits: int, estimator: str) -> None:
    force, response = measured(hits, 0.3, 0.1)
    values = frf(averaged(force, response), estimator)[0]
    used = np.ones((hits, 1), dtype=bool)
    claimed = np.sqrt(np.mean(relative_sd_of_repeats(force, response, used, estimator) ** 2))
    assert claimed == pytest.approx(values.std() / abs(values.mean()), rel=0.08)


def test_one_hit_has_no_coherence_and_two_no_spread_of_repeats() -> None:
    force, response = measured(2, 0.3)
    single = averaged(force[:1], response[:1])
    assert np.isnan(coherence(single)).all()
    assert np.isnan(relative_sd_of_coherence(single)).all()
    assert np.isnan(relative_sd_of_repeats(force, response, np.ones((2, 1), dtype=bool), "H1")).all()


def test_each_channel_averages_its_own_hits() -> None:
    force, response = measured(4, 0.3)
    both = np.concatenate([response, response], axis=1)
    used = np.array([[True, True], [True, False], [True, True], [True, True]])
    spectra = average_spectra(force, both, used)
    kept = [0, 2, 3]
    alone = averaged(force[kept], response[kept])
    assert list(spectra.averages) == [4, 3]
    assert np.allclose(frf(spectra, "H1")[1], frf(alone, "H1")[0])
    spread = relative_sd_of_repeats(force, both, used, "H1")[1]
    assert np.allclose(spread, relative_sd_of_repeats(force[kept], response[kept], used[kept, :1], "H1")[0])


@given(
    of_force=st.floats(1e-3, 1e3),
    of_response=st.floats(1e-3, 1e3),
    phase=st.floats(0.0, 6.28),
    estimator=st.sampled_from(["H1", "H2", "Hv"]),
)
def test_scales_and_phases_go_through(
    of_force: float, of_response: float, phase: float, estimator: str
) -> None:
    force, response = measured(3, 0.5, 0.1)
    force, response = force[:, :20], response[:, :, :20]
    turned = np.exp(1j * phase)
    plain, scaled = averaged(force, response), averaged(of_force * force, of_response * turned * response)
    assert np.allclose(frf(scaled, estimator), frf(plain, estimator) * of_response / of_force * turned)
    assert np.allclose(coherence(scaled), coherence(plain))
    assert (np.abs(frf(plain, "H1")) <= np.abs(frf(plain, "H2"))).all()


def test_an_unexcited_line_is_not_a_number() -> None:
    force, response = measured(3, 0.5)
    assert np.isnan(frf(averaged(0 * force, response), "H1")).all()
