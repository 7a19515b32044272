import numpy as np
import pytest

from statorhom.geometry import stator_geometry
from statorhom.materials.isotropic import Isotropic
from statorhom.mesh import MeshDensity, mesh_step, uniform
from statorhom.model.affine import Material, assemble
from statorhom.model.free_modes import solve_free
from statorhom.model.supported_modes import solve_supported
from statorhom.model.supports import support_on
from statorhom.modes.pairing import pair
from statorhom.modes.supported_names import name_supported
from statorhom.study.geometry_file import GeometryFile
from statorhom.study.supports import LineSupport

STEEL = {"lamination": Material(Isotropic(200e9, 0.3).hooke(), 7800.0)}
HIGHEST_HZ = 12000.0


@pytest.fixture(scope="module")
def model(tmp_path_factory):
    core = {
        "outer_diameter_mm": 120.0,
        "bore_diameter_mm": 96.0,
        "length_mm": 60.0,
        "yoke_thickness_mm": 12.0,
    }
    slots = {"shape": "none", "count": 24}
    keys = GeometryFile.model_validate({"schema": 1, "name": "ring", "core": core, "slots": slots})
    cells = dict(uniform(1).cells) | {"yoke": 1, "core": 3}
    geometry = stator_geometry(keys, tmp_path_factory.mktemp("ring") / "ring.toml")
    return assemble(mesh_step(geometry.step(("stack",)), MeshDensity(cells)))


def named(model, **keys):
    line = LineSupport.model_validate({"name": "line", "kind": "lines", "declared": "elastic"} | keys)
    found = solve_supported(model, STEEL, support_on(model.mesh, line), HIGHEST_HZ)
    return name_supported(found, model, STEEL)


def test_on_a_soft_line_the_modes_keep_their_free_names(model):
    modes = named(model, angles_deg=[20.0], normal_stiffness_n_per_m2=1e5)
    free = solve_free(model, STEEL, HIGHEST_HZ).modes
    expected = sorted((m.order, m.axial) for m in free if m.order is not None for _ in range(m.multiplicity))
    bending = [m for m in modes if m.frequency_hz > 500.0 and m.kind == "radial"]
    assert len(expected) >= 8
    assert sorted((m.order, m.axial) for m in bending) == expected
    assert all(m.multiplicity == 1 and m.visibility == 1.0 and m.share > 0.99 for m in bending)
    assert [m.column for m in modes] == list(range(len(modes)))


def test_the_motion_on_the_springs_is_named_too(model):
    modes = named(model, angles_deg=[0.0, 90.0, 180.0, 270.0], normal_stiffness_n_per_m2=1e8)
    lowest = modes[:6]
    # the rigid bodies: two sway and two tilt; turning and moving along the axis have no radial motion
    assert sorted((m.order, m.axial) for m in lowest if m.kind == "radial") == [
        (1, 0),
        (1, 0),
        (1, 1),
        (1, 1),
    ]
    assert sorted(m.kind for m in lowest if m.order is None) == ["axial", "torsion"]


def test_a_rigid_line_splits_and_mixes_the_orders(model):
    line = LineSupport(name="line", kind="lines", angles_deg=(20.0,), declared="rigid")
    found = solve_supported(model, STEEL, support_on(model.mesh, line), HIGHEST_HZ)
    modes = name_supported(found, model, STEEL)
    np.testing.assert_array_equal([m.frequency_hz for m in modes], found.frequencies_hz)
    assert min(m.share for m in modes if m.kind == "radial") < 0.9


def test_named_modes_pair_with_measured_ones(model):
    modes = named(model, angles_deg=[20.0], normal_stiffness_n_per_m2=1e5)
    target = next(m for m in modes if (m.order, m.axial) == (2, 0))
    assert [p.simulated for p in pair([target], modes, 0.02).pairs] == [target.column]


def test_no_modes_have_no_names(model):
    line = LineSupport(name="line", kind="lines", angles_deg=(20.0,), declared="rigid")
    found = solve_supported(model, STEEL, support_on(model.mesh, line), 20.0)
    assert len(found) == 0
    assert name_supported(found, model, STEEL) == ()
