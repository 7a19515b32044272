"""Streams fall into their hits, and records of which no FRF can come are refused."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from statorhom.errors import RecordingError
from statorhom.recordings.estimation.segments import aligned, common_frame, find_hits
from statorhom.recordings.estimation.settings import HitSettings
from synthetic_hits import RATE_HZ, hit

STREAM = ((0.3, 100.0), (1.5, 60.0), (1.52, 20.0), (2.9, 130.0))


def test_a_stream_falls_into_its_hits() -> None:
    found = find_hits([hit(7, pulses=STREAM, duration_s=4.0)], HitSettings())
    assert [one.hit.number for one in found] == [1, 2, 3]
    assert [len(one.pulses) for one in found] == [1, 2, 1]
    assert sum(len(one.hit.force_n) for one in found) == round(4.0 * RATE_HZ)


def test_single_hits_keep_the_numbers_of_their_file() -> None:
    assert [one.hit.number for one in find_hits([hit(3), hit(8)], HitSettings())] == [3, 8]


def test_hits_are_aligned_at_their_pulses() -> None:
    settings = HitSettings(pre_trigger_s=0.004)
    found = find_hits([hit(1, pulses=((0.02, 100.0),)), hit(2, pulses=((0.15, 80.0),))], settings)
    before, samples = common_frame(found, settings)
    cut = [aligned(one, before, samples) for one in found]
    assert before == round(0.004 * RATE_HZ)
    assert {one.pulses[0].start for one in cut} == {before}
    assert {one.hit.acceleration_m_s2.shape for one in cut} == {(2, samples)}
    # the later hit leaves 0.85 s, less what a fast FFT costs
    assert 0.98 * 0.854 * RATE_HZ < samples <= 0.855 * RATE_HZ


def test_mixed_sample_rates_are_one_clear_line() -> None:
    slow = replace(hit(2), sample_rate_hz=6400.0, source="b.csv")
    with pytest.raises(
        RecordingError, match=r"^b\.csv: hit 2 was sampled at 6400 Hz and .* 12800 Hz: give"
    ) as error:
        find_hits([hit(1), slow], HitSettings())
    assert "\n" not in str(error.value)


def broken(**changes: object) -> object:
    return replace(hit(1), **changes)


@pytest.mark.parametrize(
    ("records", "words"),
    [
        ([], "no time record"),
        ([broken(force_n=np.full(12800, np.nan))], "finite"),
        ([broken(acceleration_m_s2=np.full((2, 12800), np.inf))], "finite"),
        ([broken(sample_rate_hz=0.0)], "sample rate"),
        ([broken(force_n=np.zeros(5), acceleration_m_s2=np.zeros((2, 5)))], "5 samples"),
        ([broken(responses=(), acceleration_m_s2=np.zeros((0, 12800)))], "0 responses"),
    ],
)
def test_broken_records_are_refused(records: list, words: str) -> None:
    with pytest.raises(RecordingError, match=words):
        find_hits(records, HitSettings())
