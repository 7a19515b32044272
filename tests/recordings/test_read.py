"""The contents of a file decide how it is read."""

from __future__ import annotations

import numpy as np
import pytest

from example_recordings import FREQUENCY, THREE, function, ring_recording, units, write
from statorhom.errors import InputFileError, RecordingError
from statorhom.recordings.frf_groups import Frf, frf_sets
from statorhom.recordings.read import read_recording
from statorhom.recordings.uff.writer import write_uff


@pytest.mark.parametrize("name", ["recording", "recording.csv", "recording.mat.uff"])
def test_endings_do_not_matter(tmp_path, name):
    write_uff(tmp_path / name, ring_recording())
    assert len(read_recording([tmp_path / name]).frf_sets[0]) == 4


def test_a_byte_order_mark_is_tolerated(tmp_path):
    path = write(tmp_path / "x", "\ufeff", units(), function(THREE))
    assert len(read_recording([path]).frf_sets[0]) == 1


def test_hits_of_several_files_are_numbered_through(tmp_path):
    paths = [tmp_path / name for name in ("a.uff", "b.uff")]
    for seed, path in enumerate(paths):
        write_uff(path, ring_recording(seed))
    recording = read_recording(paths)
    assert [hit.number for hit in recording.hits] == [1, 2]
    assert not np.array_equal(recording.hits[0].force_n, recording.hits[1].force_n)
    [frf_set] = recording.frf_sets
    assert frf_set.accelerance.shape == (8, len(FREQUENCY)) and "1 more" in frf_set.source


def test_files_without_anything_to_use(tmp_path):
    path = write(tmp_path / "x.uff", units(), function(THREE, kind=2))
    with pytest.raises(RecordingError, match=r"holds no FRF.*1 functions of type 2 are ignored"):
        read_recording([path])
    path = write(tmp_path / "x.csv")
    with pytest.raises(RecordingError, match="is no table"):
        read_recording([path])
    with pytest.raises(RecordingError, match="cannot be read"):
        read_recording([tmp_path / "missing.uff"])
    (tmp_path / "latin.csv").write_bytes(b"frequency_hz,\xe9\n")
    with pytest.raises(InputFileError, match="not text in UTF-8"):
        read_recording([tmp_path / "latin.csv"])


def test_axes_that_print_alike_are_one():
    dof = ring_recording().frf_sets[0].responses[0]
    values = np.ones(3, complex)
    axes = (np.array([1.0, 2.0, 3.0]), np.array([1.0, 2.0, 3.00001]), np.array([1.0, 2.0, 3.1]))
    sets, remarks = frf_sets([Frf(dof, dof, axis, values) for axis in axes], "x")
    assert [len(frf_set) for frf_set in sets] == [2, 1] and len(remarks) == 1
