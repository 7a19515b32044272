"""Bases kept between runs."""

import multiprocessing
from dataclasses import replace

import numpy as np
import pytest
import wound_box as stage

from statorhom.errors import ResultsError
from statorhom.model.basis_store import BasisStore, basis_key
from statorhom.model.harmonic import harmonic_spaces
from statorhom.model.reduced import material_box


def key(**changes):
    options = {
        "mesh": stage.wound().mesh,
        "harmonic": stage.space(),
        "box": stage.box(),
        "highest_hz": stage.TOP_HZ,
        "tolerance": stage.TOLERANCE,
    }
    return basis_key(**(options | changes))


def read(store):
    return store.read(key(), stage.space(), stage.box(), stage.TOP_HZ)


@pytest.fixture
def store(tmp_path):
    made = BasisStore(tmp_path / "bases")
    made.write(key(), stage.reduced())
    return made


def test_what_is_read_is_what_was_written_to_the_last_bit(store):
    found = read(store)
    assert found.highest_hz == stage.reduced().highest_hz
    for a, b in zip(found.cells, stage.reduced().cells, strict=True):
        for one, other in zip(a.arrays, b.arrays, strict=True):
            np.testing.assert_array_equal(one, other)
            assert not one.flags.writeable
        assert [(r.residual.dropped, r.error) for r in a.rooms] == [
            (r.residual.dropped, r.error) for r in b.rooms
        ]
    assert [p.suffix for p in store.folder.iterdir()] == [".npz"]


def test_keys_tell_apart_all_that_decides_a_basis():
    others = [
        key(),
        key(harmonic=harmonic_spaces(stage.wound().mesh, 2)[1]),
        key(harmonic=harmonic_spaces(stage.wound().mesh, 3)[0]),
        key(highest_hz=stage.TOP_HZ * 1.01),
        key(tolerance=1e-3),
        key(box=material_box([stage.winding(np.zeros(3))], stage.wound().mesh.regions)),
        key(box=material_box([stage.winding(np.full(3, 1e-9))], stage.wound().mesh.regions)),
        key(box=replace(stage.box(), rooms=stage.box().rooms[::-1])),
    ]
    assert len(set(others)) == len(others)
    assert key() == others[0]


@pytest.mark.parametrize("spoil", ["cut", "empty", "text", "shape", "nan", "pickle"])
def test_a_damaged_file_is_as_good_as_none(store, spoil):
    path = store.path(key())
    content = path.read_bytes()
    if spoil in ("cut", "empty", "text"):
        path.write_bytes({"cut": content[: len(content) // 2], "empty": b"", "text": b"hello"}[spoil])
    else:
        with np.load(path) as file:
            arrays = dict(file)
        if spoil == "shape":
            arrays["mass_0_0"] = arrays["mass_0_0"][:, :-1]
        elif spoil == "nan":
            arrays["stiffness_0_0"] = np.full_like(arrays["stiffness_0_0"], np.nan)
        else:
            arrays["basis_0"] = np.array([{}], dtype=object)
        np.savez(path, **arrays)
    assert read(store) is None
    store.write(key(), stage.reduced())
    assert read(store) is not None


def test_no_file_no_basis(tmp_path):
    assert read(BasisStore(tmp_path / "nothing")) is None


def test_a_folder_that_cannot_be_made_is_one_line(tmp_path):
    (tmp_path / "file").write_text("in the way")
    with pytest.raises(ResultsError, match="cannot be written"):
        BasisStore(tmp_path / "file" / "bases").write(key(), stage.reduced())


def _write_and_read(folder):
    store = BasisStore(folder)
    store.write("shared", stage.reduced())
    found = store.read("shared", stage.space(), stage.box(), stage.TOP_HZ)
    return found is not None and found.error


@pytest.mark.slow
def test_several_processes_write_and_read_at_once(tmp_path):
    with multiprocessing.get_context("spawn").Pool(4) as pool:
        errors = pool.map(_write_and_read, [tmp_path / "bases"] * 8, chunksize=1)
    assert errors == [stage.reduced().error] * 8
    assert len(list((tmp_path / "bases").iterdir())) == 1
