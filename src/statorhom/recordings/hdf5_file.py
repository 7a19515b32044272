"""Arrays of HDF5 files, read in a process of their own: the HDF5 library may crash on a damaged file."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from statorhom.errors import MissingDependencyError
from statorhom.recordings.message import recording_error
from statorhom.study.message import one_line

_NO_LIBRARY = 3
_LONGEST_S = 600.0
# MATLAB (version 7.3) stores complex numbers as pairs, and arrays by columns, so that they appear transposed
_CHILD = f"""
import sys
try:
    import h5py
except ImportError:
    sys.exit({_NO_LIBRARY})
import numpy as np

source, target, *names = sys.argv[1:]
arrays = {{}}
with h5py.File(source, "r") as file:
    for name in names:
        dataset = file.get(name)
        if isinstance(dataset, h5py.Dataset):
            array = np.asarray(dataset[()])
            if array.dtype.names == ("real", "imag"):
                array = array["real"] + 1j * array["imag"]
            arrays[name] = array.T if "MATLAB_class" in dataset.attrs else array
np.savez(target, **{{name: array for name, array in arrays.items() if array.dtype.kind in "iufc"}})
"""


def read_hdf5_arrays(path: Path, names: tuple[str, ...]) -> dict[str, np.ndarray]:
    """The numeric arrays of some names.

    Parameters
    ----------
    path : Path
    names : tuple of str
        What to read, at the top of the file; everything else is passed over.

    Returns
    -------
    dict of str to array

    Raises
    ------
    RecordingError
    MissingDependencyError
        Without h5py.
    """
    with TemporaryDirectory() as folder:
        target = Path(folder) / "arrays.npz"
        command = [sys.executable, "-c", _CHILD, str(path.resolve()), str(target), *names]
        try:
            done = subprocess.run(command, capture_output=True, timeout=_LONGEST_S, check=False)
        except subprocess.TimeoutExpired:
            done = None
        if done is not None and done.returncode == _NO_LIBRARY:
            raise MissingDependencyError(
                f"{one_line(str(path))}: reading HDF5 needs h5py; install statorhom[hdf5]"
            )
        if done is None or done.returncode or not target.is_file():
            raise recording_error(path, "", "is no sound HDF5 file", "save or copy it again")
        with np.load(target, allow_pickle=False) as arrays:
            return dict(arrays)
