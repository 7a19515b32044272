"""FRFs in MAT and HDF5 files."""

from __future__ import annotations

import h5py
import numpy as np
import pytest
from scipy.io import savemat

from statorhom.errors import MissingDependencyError, RecordingError
from statorhom.recordings import hdf5_file
from statorhom.recordings.read import read_recording

FREQUENCY = np.array([10.0, 12.0, 14.0])
VALUES = np.array([[1 + 2j, 3 + 4j, 5 + 6j], [7 + 8j, 9 - 1j, 2 - 3j]])
ARRAYS = {
    "frequency_hz": FREQUENCY,
    "accelerance": VALUES,
    "response_node": np.array([1, 2]),
    "reference_node": np.array([9]),
    "response_mm": np.array([[60.0, 0.0, 5.0], [0.0, 60.0, 5.0]]),
    "response_direction": np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]),
    "coherence": np.full((2, 3), 0.5),
}


def hdf5(path, arrays):
    with h5py.File(path, "w") as file:
        for name, array in arrays.items():
            file[name] = array


def matlab_7_3(path, arrays):
    with h5py.File(path, "w", userblock_size=512) as file:
        for name, array in arrays.items():
            array = np.atleast_2d(array).T
            if np.iscomplexobj(array):
                pairs = np.empty(array.shape, dtype=[("real", "f8"), ("imag", "f8")])
                pairs["real"], pairs["imag"] = array.real, array.imag
                array = pairs
            file[name] = array
            file[name].attrs["MATLAB_class"] = "double"
    with path.open("r+b") as raw:
        raw.write(b"MATLAB 7.3 MAT-file")


WAYS = {
    "frf.h5": hdf5,
    "matlab.mat": matlab_7_3,
    "plain.mat": savemat,
    "packed.mat": lambda path, arrays: savemat(path, arrays, do_compression=True),
}


@pytest.mark.parametrize("name", WAYS)
def test_arrays_become_frfs(tmp_path, name):
    WAYS[name](tmp_path / name, ARRAYS)
    [found] = read_recording([tmp_path / name]).frf_sets
    np.testing.assert_array_equal(found.accelerance, VALUES)
    np.testing.assert_array_equal(found.frequency_hz, FREQUENCY)
    np.testing.assert_array_equal(found.coherence, ARRAYS["coherence"])
    assert [(dof.node, dof.direction) for dof in found.responses] == [(1, (1, 0, 0)), (2, (0, 1, 0))]
    assert found.responses[1].position == pytest.approx((0.0, 0.06, 0.005))
    assert [(dof.node, dof.position) for dof in found.references] == [(9, None), (9, None)]


@pytest.mark.parametrize(
    ("name", "array", "says"),
    [
        ("accelerance", None, "accelerance: is missing"),
        ("accelerance", VALUES[:, :2], "it is FRFs × 3 lines"),
        ("frequency_hz", FREQUENCY[::-1], "does not ascend"),
        ("response_node", np.array([1.5, 2.0]), "not all whole numbers"),
        ("response_node", np.array([1, 2, 3]), "1 values for each of 2 FRFs"),
        ("response_direction", np.ones((2, 3)), "not unit vectors"),
        ("coherence", np.ones((2, 2)), "coherence: has the shape"),
    ],
)
def test_what_is_wrong_is_said_in_one_line(tmp_path, name, array, says):
    path = tmp_path / "frf.mat"
    savemat(path, {k: v for k, v in (ARRAYS | {name: array}).items() if v is not None})
    with pytest.raises(RecordingError) as caught:
        read_recording([path])
    assert says in str(caught.value) and str(caught.value).startswith(str(path))


@pytest.mark.parametrize("name", ["frf.h5", "packed.mat"])
def test_truncated_files(tmp_path, name):
    path = tmp_path / name
    WAYS[name](path, ARRAYS)
    path.write_bytes(path.read_bytes()[:-20])
    with pytest.raises(RecordingError, match="is no sound"):
        read_recording([path])


def test_without_h5py(tmp_path, monkeypatch):
    hdf5(tmp_path / "frf.h5", ARRAYS)
    monkeypatch.setattr(hdf5_file, "_CHILD", "import sys; sys.modules['h5py'] = None\n" + hdf5_file._CHILD)
    with pytest.raises(MissingDependencyError, match=r"statorhom\[hdf5\]"):
        read_recording([tmp_path / "frf.h5"])


def test_a_crash_of_the_library_is_an_error(tmp_path, monkeypatch):
    hdf5(tmp_path / "frf.h5", ARRAYS)
    monkeypatch.setattr(hdf5_file, "_CHILD", "import os; os.abort()")
    with pytest.raises(RecordingError, match="is no sound HDF5 file"):
        read_recording([tmp_path / "frf.h5"])
