"""What is written is read back."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from example_recordings import FREQUENCY, ring_dof, ring_recording
from statorhom.errors import RecordingError
from statorhom.recordings.dof import Dof
from statorhom.recordings.frf_set import FrfSet
from statorhom.recordings.recording import Recording
from statorhom.recordings.uff.reader import read_uff
from statorhom.recordings.uff.writer import write_uff

FEW = settings(
    deadline=None,
    max_examples=60,
    derandomize=True,
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)


def round_trip(folder: Path, recording: Recording, binary: bool) -> Recording:
    write_uff(folder / "x.uff", recording, binary=binary)
    return read_uff(folder / "x.uff")


def assert_same_dofs(found: tuple[Dof, ...], expected: tuple[Dof, ...]) -> None:
    assert [dof.node for dof in found] == [dof.node for dof in expected]
    for one, other in zip(found, expected, strict=True):
        assert (one.position is None) == (other.position is None)
        np.testing.assert_allclose(one.position or (), other.position or (), rtol=1e-15)
        np.testing.assert_allclose(one.direction or (), other.direction or (), atol=1e-12)


@pytest.mark.parametrize("binary", [True, False])
def test_everything_comes_back(tmp_path, binary):
    recording = ring_recording()
    found = round_trip(tmp_path, recording, binary)
    assert (found.name, found.remarks) == ("ring", ())
    [frf_set], [expected] = found.frf_sets, recording.frf_sets
    tolerance = 0.0 if binary else 1e-11
    np.testing.assert_allclose(frf_set.accelerance, expected.accelerance, rtol=tolerance)
    np.testing.assert_allclose(frf_set.coherence, expected.coherence, rtol=tolerance)
    np.testing.assert_array_equal(frf_set.frequency_hz, FREQUENCY)
    assert_same_dofs(frf_set.responses, expected.responses)
    assert_same_dofs(frf_set.references, expected.references)
    [hit], [expected_hit] = found.hits, recording.hits
    assert (hit.number, hit.sample_rate_hz) == (3, 48000.0)
    np.testing.assert_allclose(hit.force_n, expected_hit.force_n, rtol=tolerance)
    np.testing.assert_allclose(hit.acceleration_m_s2, expected_hit.acceleration_m_s2, rtol=tolerance)
    assert_same_dofs((hit.reference, *hit.responses), (expected_hit.reference, *expected_hit.responses))
    [shape], [expected_shape] = found.shapes, recording.shapes
    assert shape.frequency_hz == pytest.approx(1432.5, rel=1e-5)
    assert shape.damping_ratio == pytest.approx(0.003, rel=1e-3)
    np.testing.assert_allclose(shape.displacement, expected_shape.displacement, rtol=1e-5)
    assert found.nodes == recording.nodes and found.trace_lines == recording.trace_lines


@FEW
@given(
    values=st.lists(st.complex_numbers(max_magnitude=1e30, allow_subnormal=False), min_size=3, max_size=9),
    angles=st.lists(st.floats(0.0, 360.0), min_size=1, max_size=4),
    direction=st.sampled_from(["r", "-r", "theta", "-theta", "z", "-z"]),
    frequencies=st.sampled_from(["even", "uneven"]),
    binary=st.booleans(),
)
def test_any_ring_comes_back(tmp_path, values, angles, direction, frequencies, binary):
    axis = 50.0 + 0.5 * np.arange(len(values)) ** (1 if frequencies == "even" else 2)
    responses = tuple(ring_dof(i, angle, 0.01, direction) for i, angle in enumerate(angles, start=1))
    accelerance = np.array([np.roll(values, i) for i in range(len(angles))])
    frf_set = FrfSet(axis, responses, (responses[0],) * len(angles), accelerance)
    [found] = round_trip(tmp_path, Recording("x", (frf_set,)), binary).frf_sets
    np.testing.assert_allclose(found.accelerance, accelerance, rtol=1e-11, atol=1e-300)
    np.testing.assert_allclose(found.frequency_hz, axis, rtol=1e-5)
    assert_same_dofs(found.responses, responses)


def test_points_without_positions_keep_cartesian_directions(tmp_path):
    dofs = (Dof(4, direction=(0.0, 0.0, -1.0)), Dof(5))
    frf_set = FrfSet(FREQUENCY, dofs, dofs[::-1], np.ones((2, len(FREQUENCY)), complex))
    [found] = round_trip(tmp_path, Recording("x", (frf_set,)), True).frf_sets
    assert_same_dofs(found.responses, dofs)


def test_undamped_shapes(tmp_path):
    shape = replace(ring_recording().shapes[0], damping_ratio=None)
    [found] = round_trip(tmp_path, Recording("x", shapes=(shape,)), True).shapes
    assert found.damping_ratio is None and found.frequency_hz == 1432.5


def test_what_the_format_cannot_say_is_refused(tmp_path):
    def refusal(*dofs: Dof) -> str:
        frf_set = FrfSet(FREQUENCY, dofs, dofs, np.ones((len(dofs), len(FREQUENCY)), complex))
        with pytest.raises(RecordingError) as caught:
            write_uff(tmp_path / "x.uff", Recording("x", (frf_set,)))
        assert not (tmp_path / "x.uff").exists()
        return str(caught.value)

    assert "node 4: has directions" in refusal(Dof(4, (1.0, 0.0, 0.0), (0.6, 0.8, 0.0)))
    assert "node 4: lies at two places" in refusal(Dof(4, (1.0, 0.0, 0.0)), Dof(4, (2.0, 0.0, 0.0)))
    assert "does not fit" in refusal(Dof(10**9, (1.0, 0.0, 0.0)))


def test_the_same_recording_gives_the_same_bytes(tmp_path):
    for name in ("a.uff", "b.uff"):
        write_uff(tmp_path / name, ring_recording())
    assert (tmp_path / "a.uff").read_bytes() == (tmp_path / "b.uff").read_bytes()
