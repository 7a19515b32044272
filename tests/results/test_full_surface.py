"""The surface closes, looks outwards, and carries modes as the harmonic says."""

import numpy as np
import pytest

from statorhom.geometry import stator_geometry
from statorhom.mesh import HalfPitchMesh, mesh_step, uniform
from statorhom.results.full_surface import FullSurface, expand_cyclic, full_surface, pitch_surface
from statorhom.study.geometry_file import GeometryFile


@pytest.fixture(scope="module")
def mesh() -> HalfPitchMesh:
    file = GeometryFile.model_validate(
        {
            "schema": 1,
            "name": "small",
            "core": {
                "outer_diameter_mm": 100,
                "bore_diameter_mm": 60,
                "length_mm": 50,
                "yoke_thickness_mm": 8,
            },
            "slots": {"count": 6, "shape": "parallel_tooth", "tooth_width_mm": 12},
            "winding": {"overhang_length_mm": 10},
        }
    )
    return mesh_step(stator_geometry(file, "small.toml").step(("stack", "wound")), uniform(1))


def enclosed_volume(surface: FullSurface) -> float:
    corners = surface.nodes[surface.quads[:, :4]]
    normal = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1]) / 2
    return float(np.sum(normal * corners.mean(axis=1)) / 3)


def polygon_ring_volume(mesh: HalfPitchMesh) -> float:
    """Volume of the elements, taken as hexahedra with straight edges."""
    p = mesh.nodes[mesh.elements[:, :8]]
    base = [(0, 1, 3, 4), (1, 2, 3, 6), (1, 3, 4, 6), (3, 4, 6, 7), (1, 4, 5, 6)]
    tets = sum(
        np.abs(np.einsum("ij,ij->i", p[:, b] - p[:, a], np.cross(p[:, c] - p[:, a], p[:, d] - p[:, a])))
        for a, b, c, d in base
    )
    return float(2 * mesh.slots * np.sum(tets) / 6)


def test_surface_encloses_the_elements(mesh: HalfPitchMesh) -> None:
    assert enclosed_volume(full_surface(mesh)) == pytest.approx(polygon_ring_volume(mesh), rel=1e-9)


def test_a_pitch_is_closed_by_its_cut_faces(mesh: HalfPitchMesh) -> None:
    part = enclosed_volume(pitch_surface(mesh))
    assert part == pytest.approx(enclosed_volume(full_surface(mesh)) / mesh.slots, rel=1e-9)


def test_surface_numbers_the_nodes_of_the_whole_mesh(mesh: HalfPitchMesh) -> None:
    surface = full_surface(mesh)
    np.testing.assert_array_equal(surface.nodes, mesh.full()[0].nodes[surface.full_node])


def test_middle_nodes_lie_between_their_corners(mesh: HalfPitchMesh) -> None:
    surface = full_surface(mesh)
    quads = surface.nodes[surface.quads]
    between = (quads[:, :4] + quads[:, [1, 2, 3, 0]]) / 2
    side = np.linalg.norm(quads[:, [1, 2, 3, 0]] - quads[:, :4], axis=2)
    assert np.all(np.linalg.norm(quads[:, 4:] - between, axis=2) < 0.15 * side)


@pytest.mark.parametrize("harmonic", [1, 2])
def test_a_wave_runs_around_the_whole_stator(mesh: HalfPitchMesh, harmonic: int) -> None:
    surface = full_surface(mesh)
    wave = np.exp(1j * harmonic * np.arctan2(mesh.nodes[:, 1], mesh.nodes[:, 0]))
    half = np.column_stack([wave, 1j * wave, 0.5 * wave])
    angle = np.arctan2(surface.nodes[:, 1], surface.nodes[:, 0])
    expected = np.column_stack(
        [np.cos(harmonic * angle), -np.sin(harmonic * angle), 0.5 * np.cos(harmonic * angle)]
    )
    np.testing.assert_allclose(expand_cyclic(surface, mesh.slots, harmonic, half), expected, atol=1e-12)


def test_an_odd_singlet_is_its_imaginary_part(mesh: HalfPitchMesh) -> None:
    surface = full_surface(mesh)
    turning = np.zeros((len(mesh.nodes), 3), dtype=complex)
    turning[:, 1] = 1j
    moved = expand_cyclic(surface, mesh.slots, 0, turning)
    np.testing.assert_allclose(moved, np.tile([0.0, 1.0, 0.0], (len(surface.nodes), 1)), atol=1e-12)
