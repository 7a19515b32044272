"""Whatever becomes of a file of measurements: it is read, or a StatorhomError says in one line why not."""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from scipy.io import savemat, wavfile

from example_recordings import FREQUENCY, THREE, function, ring_recording, units
from statorhom.errors import StatorhomError
from statorhom.recordings.csv_frf import write_csv_frf
from statorhom.recordings.placement import Placement
from statorhom.recordings.read import read_recording
from statorhom.recordings.uff.writer import write_uff

PLACEMENT = Placement((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), "r", None, 100.0, 1000.0)
NUMBER = re.compile(rb"[-+]?\d+(?:\.\d*)?(?:[eEdD][-+]?\d+)?")
REPLACEMENTS = [
    b"nan",
    b"-1",
    b"0",
    b"1e308",
    b"99999999999",
    b"x",
    b"",
    b"1e-320",
    b"7",
    b"-5",
    b"58",
    b"inf",
]


def csv_hit(path: Path) -> None:
    rows = [f"{i / 1024},{i % 3},{i % 5}" for i in range(8)]
    path.write_text("\n".join(["time_s,force_n,acceleration_m_s2", *rows, ""]))


def mat(path: Path) -> None:
    arrays = {"accelerance": np.ones((2, 6), complex), "response_node": [1, 2], "reference_node": [[9]]}
    savemat(path, {"frequency_hz": FREQUENCY, **arrays, "response_mm": np.eye(3)[:2]})


WRITERS: dict[str, Callable[[Path], object]] = {
    "binary.uff": lambda path: write_uff(path, ring_recording()),
    "text.uff": lambda path: write_uff(path, ring_recording(), binary=False),
    "short.uff": lambda path: path.write_text(units() + function(THREE) + function(THREE, even=0, count=2)),
    "frf.csv": lambda path: write_csv_frf(path, ring_recording().frf_sets),
    "hit.csv": csv_hit,
    "hit.wav": lambda path: wavfile.write(path, 48000, np.arange(24, dtype=np.int16).reshape(12, 2)),
    "frf.mat": mat,
}


@cache
def valid(name: str) -> bytes:
    with TemporaryDirectory() as folder:
        path = Path(folder) / name
        WRITERS[name](path)
        return path.read_bytes()


def mutated(content: bytes, changes: list[tuple[str, int, int]]) -> bytes:
    for what, where, value in changes:
        at = where % max(len(content), 1)
        if what == "flip":
            content = content[:at] + bytes([value]) + content[at + 1 :]
        elif what == "cut":
            content = content[:at]
        elif what == "insert":
            content = content[:at] + REPLACEMENTS[value % len(REPLACEMENTS)] + content[at:]
        elif what == "number":
            found = NUMBER.search(content, at)
            if found:
                new = REPLACEMENTS[value % len(REPLACEMENTS)].rjust(found.end() - found.start())
                content = content[: found.start()] + new + content[found.end() :]
        else:
            lines = content.split(b"\n")
            index = where % len(lines)
            lines[index : index + 1] = [] if what == "lose a line" else [lines[index]] * 2
            content = b"\n".join(lines)
    return content


CHANGES = st.lists(
    st.tuples(
        st.sampled_from(["flip", "cut", "insert", "number", "number", "lose a line", "double a line"]),
        st.integers(0, 2**16),
        st.integers(0, 255),
    ),
    min_size=1,
    max_size=4,
)


def check(path: Path, content: bytes) -> bool:
    """Whether the file is read; all that is read must be usable."""
    path.write_bytes(content)
    try:
        recording = read_recording([path], PLACEMENT)
    except StatorhomError as error:
        assert str(error).startswith(str(path)) and str(error).isprintable()
        return False
    for frf_set in recording.frf_sets:
        assert np.isfinite(frf_set.accelerance).all()
        assert (np.diff(frf_set.frequency_hz) > 0).all() and frf_set.frequency_hz[0] >= 0
    for hit in recording.hits:
        assert np.isfinite(hit.force_n).all() and np.isfinite(hit.acceleration_m_s2).all()
        assert 0 < hit.sample_rate_hz < np.inf
    assert all(remark.isprintable() for remark in recording.remarks)
    return True


def fuzz(examples: int) -> settings:
    return settings(
        deadline=None,
        max_examples=examples,
        derandomize=True,
        suppress_health_check=[HealthCheck.function_scoped_fixture],
    )


@pytest.mark.parametrize("name", WRITERS)
def test_unchanged_files_are_read(tmp_path, name):
    assert check(tmp_path / name, valid(name))


@pytest.mark.parametrize("name", WRITERS)
@fuzz(290)
@given(changes=CHANGES)
def test_damaged_files(tmp_path, name, changes):
    check(tmp_path / name, mutated(valid(name), changes))


@pytest.mark.slow
@pytest.mark.parametrize("name", WRITERS)
@fuzz(4_000)
@given(changes=CHANGES)
def test_many_damaged_files(tmp_path, name, changes):
    check(tmp_path / name, mutated(valid(name), changes))


def hdf5(path: Path) -> None:
    h5py = pytest.importorskip("h5py")
    with h5py.File(path, "w") as file:
        file["frequency_hz"], file["accelerance"] = FREQUENCY, np.ones((2, 6), complex)
        file["response_node"], file["reference_node"], file["response_mm"] = [1, 2], [9, 9], np.eye(3)[:2]


@pytest.fixture(scope="module")
def hdf5_content(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    path = tmp_path_factory.mktemp("hdf5") / "frf.h5"
    hdf5(path)
    return path.read_bytes()


def test_an_unchanged_hdf5_file_is_read(tmp_path, hdf5_content):
    assert check(tmp_path / "frf.h5", hdf5_content)


# every file is read in a process of its own, which takes a while
@pytest.mark.slow
@fuzz(2_000)
@given(changes=CHANGES)
def test_damaged_hdf5_files(tmp_path, hdf5_content, changes):
    check(tmp_path / "frf.h5", mutated(hdf5_content, changes))


@fuzz(12)
@given(changes=CHANGES)
def test_a_few_damaged_hdf5_files(tmp_path, hdf5_content, changes):
    check(tmp_path / "frf.h5", mutated(hdf5_content, changes))


@pytest.mark.parametrize("ending", ["uff", "csv", "mat", "wav", ""])
@fuzz(30)
@given(content=st.binary(max_size=200))
def test_any_bytes(tmp_path, ending, content):
    check(tmp_path / f"x.{ending}", content)
