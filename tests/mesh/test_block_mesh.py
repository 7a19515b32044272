"""Meshes of blocks: an eighth, and the whole mirrored from it."""

from __future__ import annotations

import numpy as np
import pytest

from statorhom.geometry.block import BlockGeometry
from statorhom.mesh.block import block_mesh
from statorhom.mesh.mirror_mesh import MirrorMesh
from statorhom.model.assembly import region_volumes

BLOCK = BlockGeometry("plate", (0.3, 0.2, 0.004), "test")


def test_the_eighth_has_an_eighth_of_the_volume() -> None:
    mesh = block_mesh(BLOCK)
    assert 8 * region_volumes(mesh)["plate"] == pytest.approx(BLOCK.exact_volumes()["plate"], rel=1e-12)
    assert mesh.copies == 8


def test_whole_body_is_conforming_and_spans_the_drawing() -> None:
    mesh = block_mesh(BLOCK)
    full, source, mirrored = mesh.full()
    assert 3 * len(full.nodes) == mesh.full_dof
    assert len(np.unique(np.round(full.nodes, 9), axis=0)) == len(full.nodes)
    assert full.nodes.min(axis=0) == pytest.approx(0.0, abs=1e-12)
    assert full.nodes.max(axis=0) == pytest.approx(BLOCK.size, rel=1e-12)
    # inverted elements would have a negative volume, gaps or overlaps another one
    assert region_volumes(full)["plate"] == pytest.approx(BLOCK.exact_volumes()["plate"], rel=1e-12)
    assert np.allclose(mesh.mirrored_positions(source, mirrored), full.nodes)


def test_refined_meshes_are_similar() -> None:
    cells = [len(block_mesh(BLOCK, factor).elements) for factor in (1.0, 1.5, 2.0)]
    assert [c / cells[0] for c in cells] == pytest.approx([1.0, 2.25, 4.0])


def test_cells_are_as_many_as_the_shape_needs() -> None:
    """A bar that is thin both ways has two cells each way, a plate one through half its thickness."""
    shapes = {(1.0, 0.01, 0.01): 24 * 2 * 2, (0.3, 0.2, 0.004): 12 * 8, (0.1, 0.1, 0.1): 4**3}
    for size, cells in shapes.items():
        assert len(block_mesh(BlockGeometry("beam", size, "test")).elements) == cells


@pytest.mark.parametrize("planes", [(), ((1, 0.1),), ((0, 0.15), (2, 0.002))])
def test_any_number_of_planes_mirrors_a_whole_body(planes: tuple[tuple[int, float], ...]) -> None:
    part = block_mesh(BLOCK)
    mesh = MirrorMesh(part.nodes, part.elements, part.region, part.regions, planes)
    full, _, _ = mesh.full()
    volume = BLOCK.exact_volumes()["plate"] / 8 * 2 ** len(planes)
    assert region_volumes(full)["plate"] == pytest.approx(volume, rel=1e-12)
    assert mesh.full_dof == 3 * len(full.nodes)
