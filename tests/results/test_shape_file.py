"""Shape files come back as they were written; anything else is refused in one line."""

import sys
from pathlib import Path

import numpy as np
import pytest

from statorhom.errors import ResultsError
from statorhom.results.full_surface import full_surface
from statorhom.results.shape_file import ShapeFile, read_shape_file, write_shape_file

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "report"))

from example_results import example_mesh, stack_shapes, wound_shapes


@pytest.fixture(scope="module")
def stack() -> ShapeFile:
    return stack_shapes()


def test_round_trip(stack: ShapeFile, tmp_path: Path) -> None:
    back = read_shape_file(write_shape_file(tmp_path / "shapes" / "stack.npz", stack))
    np.testing.assert_array_equal(back.mesh.nodes, stack.mesh.nodes)
    np.testing.assert_array_equal(back.mesh.elements, stack.mesh.elements)
    np.testing.assert_array_equal(back.planes_m, stack.planes_m)
    assert (back.mesh.regions, back.mesh.slots) == (stack.mesh.regions, stack.mesh.slots)
    for a, b in zip(back.modes, stack.modes, strict=True):
        names = ("frequency_hz", "harmonic", "parity", "order", "axial", "kind", "share")
        assert [getattr(a, n) for n in names] == [getattr(b, n) for n in names]
        np.testing.assert_allclose(a.displacement, b.displacement, rtol=1e-6, atol=1e-6)
        np.testing.assert_allclose(a.spectrum, b.spectrum, rtol=1e-6, atol=1e-6)


def test_both_kinds_of_modes_give_a_motion_of_the_whole_surface(stack: ShapeFile) -> None:
    surface = full_surface(stack.mesh)
    angle = np.arctan2(surface.nodes[:, 1], surface.nodes[:, 0])
    assert {mode.harmonic is None for mode in stack.modes} == {True, False}
    np.testing.assert_allclose(
        stack.displacement(surface, stack.modes[0])[:, 0], np.cos(2 * angle), atol=1e-6
    )
    assert stack.displacement(surface, stack.modes[-1]).shape == surface.nodes.shape


def test_a_file_without_modes_is_whole(tmp_path: Path) -> None:
    empty = ShapeFile(example_mesh(("stack",)), np.zeros(0), ())
    assert read_shape_file(write_shape_file(tmp_path / "empty.npz", empty)).modes == ()


def test_what_was_read_cannot_be_changed(stack: ShapeFile, tmp_path: Path) -> None:
    back = read_shape_file(write_shape_file(tmp_path / "a.npz", stack))
    with pytest.raises(ValueError, match="read-only"):
        back.modes[0].displacement[0, 0] = 1.0


def test_missing_file(tmp_path: Path) -> None:
    with pytest.raises(ResultsError, match="no such file; run the study again"):
        read_shape_file(tmp_path / "nothing.npz")


@pytest.mark.parametrize("content", [b"", b"no archive", b"PK\x03\x04 cut off"])
def test_no_archive(content: bytes, tmp_path: Path) -> None:
    path = tmp_path / "bad.npz"
    path.write_bytes(content)
    with pytest.raises(ResultsError, match="damaged"):
        read_shape_file(path)


def test_a_file_cut_short_anywhere_is_refused(tmp_path: Path) -> None:
    path = write_shape_file(tmp_path / "a.npz", wound_shapes())
    whole = path.read_bytes()
    for part in (0.1, 0.5, 0.9, 0.999):
        path.write_bytes(whole[: int(part * len(whole))])
        with pytest.raises(ResultsError, match="damaged"):
            read_shape_file(path)


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("format", np.array(99)),
        ("elements", np.full((18, 20), 10**6)),
        ("nodes", np.full((163, 3), np.nan)),
        ("displacement", np.zeros((1, 2, 3), dtype=complex)),
        ("full_displacement", np.zeros((2, 7, 3))),
        ("spectrum", np.zeros((3, 1, 1))),
        ("region", np.full(18, 5)),
        ("slots", np.array(0)),
        ("nodes", None),
        ("regions", np.array([{"a": 1}], dtype=object)),
    ],
)
def test_contents_that_contradict_each_other(
    key: str, value: np.ndarray | None, stack: ShapeFile, tmp_path: Path
) -> None:
    path = write_shape_file(tmp_path / "a.npz", stack)
    with np.load(path) as arrays:
        content = dict(arrays)
    if value is None:
        del content[key]
    else:
        content[key] = value
    np.savez(path, **content)
    with pytest.raises(ResultsError, match="damaged") as caught:
        read_shape_file(path)
    assert "\n" not in str(caught.value)
