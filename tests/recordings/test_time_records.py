"""Hits in CSV and WAV files."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.io import wavfile

from statorhom.errors import RecordingError
from statorhom.recordings.placement import Placement
from statorhom.recordings.read import read_recording
from statorhom.study.modal_tests import ModalTestKeys

TEST = ModalTestKeys.model_validate(
    {
        "name": "hits", "support": "free", "hits": ["a.wav"], "direction": "-r",
        "hammer_mm": (0.0, 60.0, 10.0), "response_mm": (60.0, 0.0, 10.0),
        "force_full_scale_n": 500.0, "acceleration_full_scale_m_s2": 1000.0,
    }
)  # fmt: skip
PLACEMENT = Placement.of_test(TEST)


def refusal(path, placement=PLACEMENT) -> str:
    with pytest.raises(RecordingError) as caught:
        read_recording([path], placement)
    assert str(caught.value).startswith(str(path)) and str(caught.value).isprintable()
    return str(caught.value)


def test_csv_with_times(tmp_path):
    path = tmp_path / "hit.csv"
    path.write_text("time_s,force_n,acceleration_m_s2\n0.0,0,1\n0.5e-3,20,2\n1.0e-3,0,3\n")
    [hit] = read_recording([path], PLACEMENT).hits
    assert hit.sample_rate_hz == pytest.approx(2000.0)
    np.testing.assert_array_equal(hit.force_n, [0, 20, 0])
    np.testing.assert_array_equal(hit.acceleration_m_s2, [[1, 2, 3]])
    assert hit.responses[0].direction == pytest.approx((-1.0, 0.0, 0.0))
    assert hit.reference.direction == pytest.approx((0.0, -1.0, 0.0), abs=1e-15)
    assert hit.reference.position == pytest.approx((0.0, 0.06, 0.01))


def test_csv_with_a_sample_rate_and_several_sensors(tmp_path):
    paths = [tmp_path / f"hit-{i}.csv" for i in (1, 2)]
    for path in paths:
        path.write_text("force_n,acceleration_101_m_s2,acceleration_102_m_s2\n0,1,4\n20,2,5\n")
    hits = read_recording(paths, Placement(sample_rate_hz=48000.0)).hits
    assert [(hit.number, hit.sample_rate_hz, hit.source) for hit in hits] == [
        (1, 48000.0, str(paths[0])),
        (2, 48000.0, str(paths[1])),
    ]
    assert [dof.node for dof in hits[0].responses] == [101, 102]
    np.testing.assert_array_equal(hits[0].acceleration_m_s2, [[1, 2], [4, 5]])
    assert hits[0].responses[0].direction is None


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("force_n,acceleration_m_s2\n0,1\n", "sample_rate_hz"),
        ("time_s,force_n\n0,1\n1,2\n", "acceleration_m_s2 is missing"),
        ("time_s,force_n,acceleration_g\n0,1,2\n1,2,3\n", 'unknown column "acceleration_g"'),
        ("time_s,force_n,acceleration_m_s2\n0,1,2\n1,nan,3\n", "row 2, column force_n"),
        ("time_s,force_n,acceleration_m_s2\n0,1,2\n1,2,3\n3,2,3\n", "not evenly spaced"),
        ("time_s,force_n,acceleration_m_s2\n0,1,2\n", "single sample"),
    ],
)
def test_what_is_wrong_with_a_table(tmp_path, text, says):
    path = tmp_path / "hit.csv"
    path.write_text(text)
    assert says in refusal(path)


def test_times_that_contradict_the_study(tmp_path):
    path = tmp_path / "hit.csv"
    path.write_text("time_s,force_n,acceleration_m_s2\n0,1,2\n1,2,3\n2,3,4\n")
    assert "1 samples per second, but sample_rate_hz is 1000" in refusal(
        path, Placement(sample_rate_hz=1000.0)
    )


@pytest.mark.parametrize(
    ("samples", "full_scale"),
    [
        (np.array([[0, 100], [-32768, 200]], dtype=np.int16), 2**15),
        (np.array([[0, 100], [-(2**31), 200]], dtype=np.int32), 2**31),
        (np.array([[0.0, 0.5], [-1.0, 0.25]], dtype=np.float32), 1.0),
    ],
)
def test_wav_in_parts_of_full_scale(tmp_path, samples, full_scale):
    path = tmp_path / "hit.wav"
    wavfile.write(path, 48000, samples)
    [hit] = read_recording([path], PLACEMENT).hits
    assert hit.sample_rate_hz == 48000.0
    np.testing.assert_allclose(hit.force_n, [0.0, -500.0])
    np.testing.assert_allclose(hit.acceleration_m_s2, 1000.0 * samples[:, 1:].T / full_scale)


def test_bytes_lie_around_128(tmp_path):
    path = tmp_path / "hit.wav"
    wavfile.write(path, 8000, np.array([[128, 0], [192, 128]], dtype=np.uint8))
    [hit] = read_recording([path], PLACEMENT).hits
    np.testing.assert_array_equal(hit.force_n, [0.0, 250.0])
    np.testing.assert_array_equal(hit.acceleration_m_s2, [[-1000.0, 0.0]])


def test_what_is_wrong_with_a_wav_file(tmp_path):
    path = tmp_path / "hit.wav"
    wavfile.write(path, 48000, np.zeros((40, 3), dtype=np.int16))
    assert [dof.node for dof in read_recording([path], PLACEMENT).hits[0].responses] == [1, 2]
    assert "force_full_scale_n" in refusal(path, Placement())
    assert "sample_rate_hz differs" in refusal(path, Placement(None, None, None, 44100.0, 1.0, 1.0))
    path.write_bytes(path.read_bytes()[:-21])
    assert "no complete WAV file" in refusal(path)
    wavfile.write(path, 48000, np.zeros(40, dtype=np.int16))
    assert "single channel" in refusal(path)
