"""From synthetic hits on an exactly known structure to its receptances, and every fault on its hit."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from statorhom.errors import RecordingError
from statorhom.recordings.dof import Dof
from statorhom.recordings.estimation.estimate import estimate_frf
from statorhom.recordings.estimation.settings import HitSettings
from statorhom.recordings.estimation.windows import true_pole
from statorhom.recordings.hit import Hit
from synthetic_hits import (
    DAMPING,
    FREQUENCIES_HZ,
    RATE_HZ,
    RESPONSES,
    accelerance,
    damping_ratio,
    hit,
    receptance,
)

DOUBLE = ((0.02, 100.0), (0.05, 30.0))
HITS = [hit(number, seed=3) for number in range(1, 5)]


def overloaded(one: Hit, channel: int, level: float = 0.6) -> Hit:
    acceleration = one.acceleration_m_s2.copy()
    limit = level * np.abs(acceleration[channel]).max()
    acceleration[channel] = np.clip(acceleration[channel], -limit, limit)
    return replace(one, acceleration_m_s2=acceleration)


def near_modes(frequency_hz: np.ndarray) -> np.ndarray:
    return np.abs(frequency_hz[:, np.newaxis] / FREQUENCIES_HZ - 1).min(axis=1) < 0.02


def test_receptance_of_equation_4_is_the_exact_one() -> None:
    estimate = estimate_frf([hit(noise=0.0, duration_s=2.0)])
    (frfs,) = estimate.frf_sets
    exact = receptance(frfs.frequency_hz)
    near = near_modes(frfs.frequency_hz)
    assert np.abs(frfs.receptance / exact - 1)[:, near].max() < 0.005
    assert estimate.faults == ()
    assert frfs.coherence is None
    assert frfs.relative_sd is None
    assert estimate.used_hits == ((1,), (1,))
    assert frfs.frequency_hz[0] > 0.0
    assert frfs.frequency_hz[-1] <= estimate.upper_hz < 0.5 * RATE_HZ


def test_the_exponential_window_is_the_transfer_function_beside_the_imaginary_axis() -> None:
    (frfs,) = estimate_frf([hit(noise=0.0)], HitSettings(exponential_end_level=1e-3)).frf_sets
    decay = frfs.window_decay_per_s
    assert decay == pytest.approx(np.log(1e3) / 0.985, rel=0.01)
    exact = accelerance(frfs.frequency_hz, decay)
    near = near_modes(frfs.frequency_hz)
    assert np.abs(frfs.accelerance / exact - 1)[:, near].max() < 0.005


@cache
def long_hits(seed: int) -> tuple[Hit, ...]:
    return tuple(hit(number, seed=seed, duration_s=5.0) for number in (1, 2, 3))


@pytest.mark.parametrize("end_level", [1.0, 0.01, 1e-4])
def test_damping_is_unbiased_whatever_the_window(end_level: float) -> None:
    ratios = []
    for seed in range(5):
        estimate = estimate_frf(long_hits(seed), HitSettings(exponential_end_level=end_level))
        assert estimate.faults == ()
        (frfs,) = estimate.frf_sets
        ratios.append([_true_damping(frfs, k) / DAMPING[k] for k in range(3)])
    assert np.mean(ratios, axis=0) == pytest.approx(np.ones(3), abs=0.03)


def _true_damping(frfs, mode: int) -> float:
    near = FREQUENCIES_HZ[mode]
    natural = 2 * np.pi * near
    ratio = damping_ratio(frfs.frequency_hz, frfs.accelerance[0], near)
    pole = true_pole(natural * (-ratio + 1j), frfs.window_decay_per_s)
    return -pole.real / natural


def test_every_fault_is_reported_on_its_hit_and_no_other() -> None:
    hits = [hit(number, seed=1, duration_s=5.0) for number in range(1, 7)]
    hits[1] = hit(2, seed=1, duration_s=5.0, pulses=DOUBLE)
    hits[3] = overloaded(hits[3], channel=1)
    estimate = estimate_frf(hits, HitSettings(exponential_end_level=0.01))
    assert [(f.hit, f.channel, f.kind) for f in estimate.faults] == [
        (2, None, "double_hit"),
        (4, 1, "overload"),
    ]
    assert "30.0 ms after it; left out" in estimate.faults[0].statement
    assert "node 102" in estimate.faults[1].statement
    # an overloaded accelerometer does not spoil the others
    assert estimate.used_hits == ((1, 3, 4, 5, 6), (1, 3, 5, 6))


@pytest.mark.parametrize("seeds", [range(6), pytest.param(range(100, 300), marks=pytest.mark.slow)])
def test_clean_hits_have_no_faults(seeds: range) -> None:
    for seed in seeds:
        width = np.random.default_rng(seed).uniform(2e-4, 2e-3)
        hits = [
            hit(number, seed=seed, noise=noise, width_s=width)
            for number, noise in enumerate((0.0, 0.003, 0.01, 0.03))
        ]
        assert estimate_frf(hits).faults == ()


@pytest.mark.parametrize("seeds", [range(8), pytest.param(range(100, 300), marks=pytest.mark.slow)])
def test_double_hits_are_found(seeds: range) -> None:
    for seed in seeds:
        rng = np.random.default_rng(seed)
        gap, height = rng.uniform(0.002, 0.3), rng.uniform(20.0, 150.0)
        double = hit(2, seed=seed, pulses=((0.02, 100.0), (0.02 + gap, height)))
        found = estimate_frf([hit(1, seed=seed), double])
        assert [(fault.hit, fault.kind) for fault in found.faults] == [(2, "double_hit")]
        assert found.used_hits[0] == (1,)


def test_a_double_hit_that_is_kept_gives_the_right_frf() -> None:
    kept = estimate_frf(
        [hit(2, noise=0.0, duration_s=2.0, pulses=DOUBLE)], HitSettings(keep=frozenset({"double_hit"}))
    )
    (frfs,) = kept.frf_sets
    # both pulses are inside the force window, so the FRF is right all the same
    near = near_modes(frfs.frequency_hz)
    assert np.abs(frfs.accelerance / accelerance(frfs.frequency_hz) - 1)[:, near].max() < 0.005


@pytest.mark.parametrize(
    ("records", "settings", "expected"),
    [
        ([hit(duration_s=0.15)], HitSettings(), (1, 0, "leakage")),
        ([hit()], HitSettings(highest_hz=6000.0), (1, None, "bandwidth")),
        (
            [hit(i, noise=0.003, width_s=(4e-4 if i < 4 else 4e-3)) for i in range(1, 5)],
            None,
            (4, None, "bandwidth"),
        ),
        ([*HITS, hit(9, pulses=((0.02, 5.0),))], HitSettings(), (9, None, "weak")),
        ([hit(noise=0.07)], HitSettings(), (1, None, "noisy_force")),
        ([*HITS, hit(9, pulses=((0.02, 0.0),))], HitSettings(), (9, None, "no_hit")),
        ([*HITS, hit(9, duration_s=0.3)], HitSettings(), (9, None, "short")),
        (
            [replace(HITS[0], acceleration_m_s2=HITS[0].acceleration_m_s2 * [[1.0], [0.0]])],
            None,
            (1, 1, "weak"),
        ),
    ],
    ids=lambda value: value[2] if isinstance(value, tuple) else "",
)
def test_other_faults(records: list[Hit], settings: HitSettings | None, expected: tuple) -> None:
    assert expected in [
        (fault.hit, fault.channel, fault.kind) for fault in estimate_frf(records, settings).faults
    ]


def test_a_clipped_force_spoils_all_channels_of_its_hit() -> None:
    hits = [hit(number, seed=5, width_s=1.5e-3) for number in (1, 2, 3)]
    limit = 0.7 * hits[1].force_n.max()
    hits[1] = replace(hits[1], force_n=np.minimum(hits[1].force_n, limit))
    estimate = estimate_frf(hits)
    assert [(fault.hit, fault.channel, fault.kind) for fault in estimate.faults] == [(2, None, "overload")]
    assert estimate.used_hits == ((1, 3), (1, 3))
    kept = estimate_frf(hits, HitSettings(keep=frozenset({"overload"})))
    assert kept.used_hits == ((1, 2, 3), (1, 2, 3))
    assert "left out" not in kept.faults[0].statement


def test_an_exponential_window_cures_leakage() -> None:
    assert estimate_frf([hit(duration_s=0.15)], HitSettings(exponential_end_level=0.01)).faults == ()


def test_set_ups_of_a_roving_sensor_become_rows_of_one_set() -> None:
    roving = [Dof(node) for node in (11, 12, 13)]
    hits = [
        hit(number, seed=node.node, responses=(node, RESPONSES[1])) for node in roving for number in (1, 2)
    ]
    estimate = estimate_frf(hits, HitSettings(highest_hz=3000.0))
    (frfs,) = estimate.frf_sets
    assert [dof.node for dof in frfs.responses] == [11, 102, 12, 102, 13, 102]
    assert {dof.node for dof in frfs.references} == {901}
    assert frfs.coherence is not None
    assert frfs.coherence.shape == frfs.accelerance.shape
    assert frfs.frequency_hz[-1] <= 3000.0


def test_a_stream_gives_what_its_hits_give() -> None:
    starts = (0.1, 1.4, 2.8)
    stream = hit(noise=0.0, pulses=tuple((start, 100.0) for start in starts), duration_s=4.2)
    estimate = estimate_frf([stream])
    (frfs,) = estimate.frf_sets
    assert estimate.used_hits[0] == (1, 2, 3)
    near = near_modes(frfs.frequency_hz)
    assert np.abs(frfs.accelerance / accelerance(frfs.frequency_hz) - 1)[:, near].max() < 0.01
    assert all(b - a == pytest.approx(frfs.frequency_hz[0]) for a, b in pairwise(frfs.frequency_hz[:10]))


@pytest.mark.parametrize("records", [[hit(pulses=((0.02, 0.0),))], [hit(pulses=DOUBLE)]])
def test_no_hit_left_is_one_clear_line(records: list[Hit]) -> None:
    with pytest.raises(RecordingError, match="synthetic: hit 1") as error:
        estimate_frf(records)
    assert "\n" not in str(error.value)


@settings(max_examples=8, deadline=None)
@given(of_force=st.floats(-50, 50).filter(lambda x: abs(x) > 0.01), of_response=st.floats(1e-3, 1e3))
def test_frfs_scale_with_the_response_and_inversely_with_the_force(
    of_force: float, of_response: float
) -> None:
    scaled = [
        replace(one, force_n=of_force * one.force_n, acceleration_m_s2=of_response * one.acceleration_m_s2)
        for one in HITS
    ]
    plain, other = estimate_frf(HITS), estimate_frf(scaled)
    a, b = plain.frf_sets[0], other.frf_sets[0]
    assert np.allclose(b.accelerance, a.accelerance * of_response / of_force, rtol=1e-6)
    assert np.allclose(b.coherence, a.coherence, rtol=1e-6)
    assert other.faults == plain.faults


def test_frfs_do_not_depend_on_the_order_of_channels_and_hits() -> None:
    turned = [
        replace(one, responses=one.responses[::-1], acceleration_m_s2=one.acceleration_m_s2[::-1])
        for one in HITS
    ]
    a, b = estimate_frf(HITS).frf_sets[0], estimate_frf(turned[::-1]).frf_sets[0]
    assert b.responses == a.responses[::-1]
    assert np.allclose(b.accelerance, a.accelerance[::-1])


def test_frfs_are_linear_in_the_response() -> None:
    summed = [
        replace(
            one, acceleration_m_s2=np.array([one.acceleration_m_s2.sum(axis=0), one.acceleration_m_s2[1]])
        )
        for one in HITS
    ]
    a, b = estimate_frf(HITS).frf_sets[0], estimate_frf(summed).frf_sets[0]
    assert np.allclose(b.accelerance[0], a.accelerance.sum(axis=0))


@pytest.mark.parametrize("spread", ["coherence", "repeats"])
def test_relative_sd_is_the_scatter_of_repeated_measurements(spread: str) -> None:
    measured = [
        estimate_frf(
            [hit(n, seed=seed) for n in range(5)], HitSettings(spread=spread, highest_hz=3000.0)
        ).frf_sets[0]
        for seed in range(8)
    ]
    shortest = min((one.frequency_hz for one in measured), key=len)
    lines = np.flatnonzero(near_modes(shortest))
    values = np.array([one.accelerance[0, lines] for one in measured])
    scatter = np.sqrt(np.mean(np.var(values, axis=0, ddof=1) / np.abs(values.mean(axis=0)) ** 2))
    claimed = np.sqrt(np.mean([one.relative_sd[0, lines] ** 2 for one in measured]))
    assert claimed == pytest.approx(scatter, rel=0.15)


@pytest.mark.parametrize(
    "wrong",
    [
        {"estimator": "H3"},
        {"spread": "guess"},
        {"keep": frozenset({"typo"})},
        {"exponential_end_level": 0.0},
        {"highest_hz": -1.0},
        {"separation_s": 0.0},
    ],
)
def test_settings_outside_their_range_are_refused(wrong: dict) -> None:
    with pytest.raises(RecordingError, match=next(iter(wrong))):
        HitSettings(**wrong)
