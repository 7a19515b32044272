"""Shapes of blocks: written, read back and drawn on the whole surface."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from statorhom.errors import ResultsError
from statorhom.geometry.block import BlockGeometry
from statorhom.mesh.block import block_mesh
from statorhom.results.full_surface import full_surface
from statorhom.results.shape_file import ModeShape, ShapeFile, read_shape_file, write_shape_file

MESH = block_mesh(BlockGeometry("plate", (0.3, 0.2, 0.01), "test"))


def shape(parities: int, displacement: np.ndarray) -> ModeShape:
    return ModeShape(200.0, displacement, parities, "mirror", None, None, "bending", 0.0, np.zeros((0, 0)))


def test_the_surface_is_closed_and_outside() -> None:
    surface = full_surface(MESH)
    corners = surface.nodes[surface.quads[:, :4]]
    area = 0.5 * np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    assert np.linalg.norm(area, axis=1).sum() == pytest.approx(2 * (0.3 * 0.2 + 0.3 * 0.01 + 0.2 * 0.01))
    outwards = np.einsum("qi,qi->q", area, corners.mean(axis=1) - np.array([0.15, 0.1, 0.005]))
    assert np.all(outwards > 0)


@pytest.mark.parametrize("parities", range(8))
def test_a_motion_of_the_whole_body_comes_back_from_its_part(parities: int) -> None:
    """Products of odd and even functions about the middle planes, as the parities say."""

    def motion(nodes: np.ndarray) -> np.ndarray:
        centred = (nodes - np.array([0.15, 0.1, 0.005])) / np.array([0.15, 0.1, 0.005])
        u = np.ones((len(nodes), 3))
        for plane in range(3):
            odd = np.full(3, bool(parities >> plane & 1))
            odd[plane] = not odd[plane]  # an image's normal component is turned round
            u *= np.where(odd, centred[:, plane, None], 1 + centred[:, plane, None] ** 2)
        return u

    surface = full_surface(MESH)
    drawn = ShapeFile(MESH, np.zeros(0), ()).displacement(surface, shape(parities, motion(MESH.nodes)))
    assert drawn == pytest.approx(motion(surface.nodes), abs=1e-12)


def test_files_round_trip(tmp_path: Path) -> None:
    moved = np.random.default_rng(0).standard_normal(MESH.nodes.shape)
    path = write_shape_file(tmp_path / "a.npz", ShapeFile(MESH, np.zeros(0), (shape(5, moved),)))
    found = read_shape_file(path)
    assert found.mesh.mirrors == MESH.mirrors  # type: ignore[union-attr]
    assert found.modes[0].harmonic == 5 and found.modes[0].parity == "mirror"
    assert found.modes[0].displacement.real == pytest.approx(moved, rel=1e-6)


def test_planes_that_contradict_each_other_are_refused(tmp_path: Path) -> None:
    path = write_shape_file(tmp_path / "a.npz", ShapeFile(MESH, np.zeros(0), ()))
    with np.load(path) as file:
        content = dict(file)
    content["mirror_axes"] = np.array([0, 0, 2])
    np.savez(path, **content)
    with pytest.raises(ResultsError, match="planes of symmetry"):
        read_shape_file(path)
