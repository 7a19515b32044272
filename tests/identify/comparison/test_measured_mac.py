"""MAC of what sensors on a plate saw and the simulated shapes."""

from __future__ import annotations

import numpy as np
import pytest

from statorhom.geometry.block import BlockGeometry
from statorhom.identify.comparison.measured_mac import with_mac
from statorhom.identify.comparison.stage_shapes import shape_file
from statorhom.identify.stages.block_names import block_names
from statorhom.materials.isotropic import Isotropic
from statorhom.mesh.block import block_mesh
from statorhom.model.affine import Material, assemble
from statorhom.model.free_modes import solve_free
from statorhom.modes.point_shape import PointShape
from statorhom.results.full_surface import full_surface
from statorhom.results.schema import ModeResult
from statorhom.results.shape_file import ShapeFile

SIZE = (0.3, 0.2, 0.004)


@pytest.fixture(scope="module")
def simulated() -> ShapeFile:
    model = assemble(block_mesh(BlockGeometry("plate", SIZE, "test")))
    solution = solve_free(model, {"plate": Material(Isotropic(70e9, 0.33).hooke(), 2700.0)}, 700.0)
    return shape_file(model, solution, solution.modes, block_names(model.mesh, solution))


def sensors() -> np.ndarray:
    """5 × 4 accelerometers on the upper face."""
    x, y = np.meshgrid(np.linspace(0.01, 0.29, 5), np.linspace(0.01, 0.19, 4))
    return np.column_stack([x.ravel(), y.ravel(), np.full(x.size, SIZE[2])])


def seen(simulated: ShapeFile, number: int, positions: np.ndarray) -> PointShape:
    """What the sensors would see of a mode, turned in phase."""
    surface = full_surface(simulated.mesh)
    moved = simulated.displacement(surface, simulated.modes[number])
    nearest = [int(np.argmin(np.linalg.norm(surface.nodes - p, axis=1))) for p in positions]
    upwards = np.tile([0.0, 0.0, 1.0], (len(positions), 1))
    return PointShape(positions, upwards, moved[nearest, 2] * np.exp(0.7j))


def results(simulated: ShapeFile, shapes: tuple[PointShape, ...]) -> list[float | None]:
    modes = [ModeResult(test="free", role="fitted", shape=i, label=str(i + 1)) for i in range(2)]
    return [mode.mac for mode in with_mac(modes, simulated, {"free": shapes})]


def test_the_modes_have_their_nodal_lines(simulated: ShapeFile) -> None:
    assert {m.kind for m in simulated.modes} >= {
        "torsion (1, 1)",
        "bending (2, 0)",
        "chordwise bending (0, 2)",
    }


def test_a_mode_is_like_itself_and_unlike_the_next(simulated: ShapeFile) -> None:
    first, second = (seen(simulated, i, sensors()) for i in range(2))
    assert results(simulated, (first, second)) == pytest.approx([1.0, 1.0], abs=1e-6)
    assert max(value or 0.0 for value in results(simulated, (second, first))) < 0.1


def test_few_sensors_or_another_frame_say_nothing(simulated: ShapeFile) -> None:
    few = seen(simulated, 0, sensors()[:4])
    assert results(simulated, (few, few)) == [None, None]
    shape = seen(simulated, 0, sensors())
    elsewhere = PointShape(shape.positions_m + 0.5, shape.directions, shape.values.copy())
    assert results(simulated, (elsewhere, elsewhere)) == [None, None]
