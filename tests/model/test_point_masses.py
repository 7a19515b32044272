"""Point masses in the mass matrix."""

from __future__ import annotations

import numpy as np
import pytest

from statorhom.geometry.tested_object import object_geometry
from statorhom.geometry.wing import WingGeometry
from statorhom.materials.isotropic import Isotropic
from statorhom.mesh.wing import wing_mesh
from statorhom.model.affine import AffineModel, Material, assemble
from statorhom.study.object_file import read_object
from statorhom.study.wing_file import LUMPS
from wing_study import SMALL_WING, write_wing

SOLID = Material(Isotropic(7e9, 0.3).hooke(), 1500.0)
MASSES = {"cloth": SOLID, "foam": SOLID, LUMPS: Material(SOLID.hooke, 1.0)}
SECOND = '[[wing.lumps]]\nname = "battery"\nmass_g = 40.0\nx_mm = 150.0\ny_mm = 0.0\n[wing.density'


@pytest.fixture(scope="module")
def model(tmp_path_factory: pytest.TempPathFactory) -> AffineModel:
    folder = tmp_path_factory.mktemp("lumps")
    write_wing(folder, geometry=SMALL_WING.replace("[wing.density", SECOND))
    path = folder / "object.toml"
    geometry = object_geometry(read_object(path), path)
    assert isinstance(geometry, WingGeometry) and geometry.lump_mass == pytest.approx(0.070)
    return assemble(wing_mesh(geometry))


def only_lumps(model: AffineModel, motion: np.ndarray) -> float:
    """2 T / v² of both halves: kinetic energy of the lumps alone in a motion (n, 3)."""
    u = motion.ravel()
    return 2.0 * float(u @ (model.mass_term(LUMPS) @ u))


def test_lumps_weigh_what_they_do(model: AffineModel) -> None:
    for axis in np.eye(3):
        moved = np.broadcast_to(axis, model.mesh.nodes.shape)
        assert only_lumps(model, moved) == pytest.approx(0.070)
    assert model.volumes[LUMPS] == pytest.approx(0.070)


def test_lumps_stand_where_the_file_says(model: AffineModel) -> None:
    x, y, _ = model.mesh.nodes.T
    expected = {"x": 0.030 * 0.200**2 + 0.040 * 0.150**2, "y": 0.030 * 0.390**2}
    for name, place in (("x", x), ("y", y)):
        # a linear field is in the elements' space: ∑ m (place)²
        moved = np.column_stack([np.zeros_like(x), np.zeros_like(x), place])
        assert only_lumps(model, moved) == pytest.approx(expected[name], rel=1e-9)


def test_lumps_have_mass_alone(model: AffineModel) -> None:
    assert LUMPS not in model.stiffness
    lighter = model.mass_matrix({**MASSES, LUMPS: Material(SOLID.hooke, 0.0)})
    assert abs(model.mass_matrix(MASSES) - lighter - model.mass_term(LUMPS)).max() < 1e-12
