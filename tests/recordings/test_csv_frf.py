"""FRFs in CSV files."""

from __future__ import annotations

import numpy as np
import pytest

from example_recordings import ring_recording
from statorhom.errors import RecordingError
from statorhom.recordings.csv_frf import write_csv_frf
from statorhom.recordings.dof import Dof
from statorhom.recordings.frf_set import FrfSet
from statorhom.recordings.placement import Placement
from statorhom.recordings.read import read_recording

HEAD = "frequency_hz,real,imag,response_node,response_direction,reference_node,reference_direction"


@pytest.fixture
def path(tmp_path):
    return tmp_path / "frf.csv"


def refusal(path, text: str) -> str:
    path.write_text(text)
    with pytest.raises(RecordingError) as caught:
        read_recording([path])
    assert str(caught.value).startswith(str(path)) and str(caught.value).isprintable()
    return str(caught.value)


def test_sets_come_back_with_all_digits(path):
    [expected] = ring_recording().frf_sets
    write_csv_frf(path, (expected,))
    [found] = read_recording([path]).frf_sets
    np.testing.assert_array_equal(found.accelerance, expected.accelerance)
    np.testing.assert_array_equal(found.coherence, expected.coherence)
    np.testing.assert_array_equal(found.frequency_hz, expected.frequency_hz)
    for one, other in zip(
        found.responses + found.references, expected.responses + expected.references, strict=True
    ):
        assert one.node == other.node
        np.testing.assert_allclose(one.position, other.position, rtol=1e-15)
        np.testing.assert_allclose(one.direction, other.direction, rtol=1e-15, atol=1e-15)


def test_rows_of_several_pairs_may_alternate(path):
    path.write_text(f"# a comment\n{HEAD}\n1,1,2,1,x,9,-z\n1,3,4,2,y,9,-z\n2,5,6,1,x,9,-z\n2,7,8,2,y,9,-z\n")
    [found] = read_recording([path]).frf_sets
    np.testing.assert_array_equal(found.accelerance, [[1 + 2j, 5 + 6j], [3 + 4j, 7 + 8j]])
    assert found.responses[1] == Dof(2, None, (0.0, 1.0, 0.0))
    assert found.references[0].direction == (-0.0, -0.0, -1.0)


def test_one_frf_whose_points_the_study_knows(path):
    path.write_text("frequency_hz,amplitude,phase_deg\n10,2,90\n11,2,-90\n")
    placement = Placement(hammer_mm=(0.0, 60.0, 10.0), response_mm=(60.0, 0.0, 10.0), direction="r")
    [found] = read_recording([path], placement).frf_sets
    np.testing.assert_allclose(found.accelerance, [[2j, -2j]], atol=1e-15)
    assert found.responses[0].position == pytest.approx((0.06, 0.0, 0.01))
    assert found.responses[0].direction == (1.0, 0.0, 0.0)
    assert found.references[0].direction == pytest.approx((0.0, 1.0, 0.0))


def test_files_of_single_frfs_make_one_set(tmp_path):
    paths = [tmp_path / name for name in ("a.csv", "b.csv")]
    for node, path in enumerate(paths, start=1):
        path.write_text(f"{HEAD}\n1,1,2,{node},x,9,z\n2,3,4,{node},x,9,z\n")
    [found] = read_recording(paths).frf_sets
    assert [dof.node for dof in found.responses] == [1, 2]


def test_what_is_wrong_is_said_in_one_line(path):
    assert "column imag is missing" in refusal(path, "frequency_hz,real\n1,2\n")
    assert 'did you mean "frequency_hz"' in refusal(path, "frequency,real,imag\n1,2,3\n")
    assert "not separated by commas" in refusal(path, "frequency_hz;real;imag\n1;2;3\n")
    assert "row 2, column real" in refusal(path, "frequency_hz,real,imag\n1,2,3\n2,3 dB,3\n")
    assert "do not ascend" in refusal(path, "frequency_hz,real,imag\n2,2,3\n1,3,3\n")
    assert "no rows" in refusal(path, "frequency_hz,real,imag\n")
    assert "is no table" in refusal(path, "frequency_hz,real,imag\n1,2,3,4,5\n")
    assert '"up" is no direction' in refusal(path, f"{HEAD}\n1,1,2,1,up,9,z\n")
    assert "row 1, column reference_node" in refusal(path, f"{HEAD}\n1,1,2,1,x,9.5,z\n")
    assert "column response_z_mm is missing" in refusal(
        path, f"{HEAD},response_x_mm,response_y_mm\n1,1,2,1,x,9,z,1,2\n"
    )
    assert "no FRF" in refusal(path, "frequency_hz,real,imag\n1,nan,3\n2,nan,3\n")


def test_directions_without_a_name_are_not_written(path):
    dof = Dof(4, (1.0, 0.0, 0.0), (0.6, 0.8, 0.0))
    with pytest.raises(RecordingError, match="node 4"):
        write_csv_frf(path, (FrfSet(np.array([1.0]), (dof,), (dof,), np.ones((1, 1), complex)),))
    with pytest.raises(RecordingError, match="no FRF"):
        write_csv_frf(path, ())
    assert not path.exists()
