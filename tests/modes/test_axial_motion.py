"""Axial motion of a radial mode: the thin ring's, and a full model's."""

from __future__ import annotations

import numpy as np
import pytest

from statorhom.modes.axial_motion import axial_lever, sheets_slide


def test_the_lever_grows_with_the_radius_and_falls_with_the_order() -> None:
    levers = [axial_lever(order, 1, 0.06, slides=False).length_m for order in (2, 3, 4, 5)]
    assert np.all(np.diff(levers) < 0)
    assert axial_lever(2, 1, 0.12, slides=False).length_m == pytest.approx(2 * levers[0])


def test_sheets_that_slide_leave_it_open() -> None:
    firm, unknown, soft = (axial_lever(2, 1, 0.06, slides) for slides in (False, None, True))
    assert firm.length_m == unknown.length_m == soft.length_m
    assert firm.sd_m < unknown.sd_m < soft.sd_m == np.inf


def test_sheets_slide_where_antisymmetric_modes_lie_low() -> None:
    assert sheets_slide({(2, 0): 1432.0, (2, 1): 1974.0, (3, 0): 3715.0}) is False
    assert sheets_slide({(2, 0): 1400.0, (2, 1): 1324.0}) is True
    assert sheets_slide({(2, 0): 1400.0, (3, 1): 1324.0, (1, 1): 900.0, (1, 0): 950.0}) is None


@pytest.mark.parametrize(
    ("yoke_mm", "shear_pa", "slides"),
    [(8.0, 43e9, False), (8.0, 20e9, False), (15.0, 30e9, False), (15.0, 15e9, False), (15.0, 3e9, True)],
)
def test_it_agrees_with_the_full_model(yoke_mm: float, shear_pa: float, slides: bool) -> None:
    """Within two standard deviations on plain rings that had no part in the lever's figures."""
    from example_stators import stator
    from statorhom.identify.comparison.simulated_shapes import shape_grid, surface_motion
    from statorhom.materials.transversely_isotropic import TransverselyIsotropic
    from statorhom.mesh import MeshDensity, mesh_step, uniform
    from statorhom.model.affine import Material, assemble
    from statorhom.model.free_modes import solve_free

    core = {"bore_diameter_mm": 120 - 2 * yoke_mm, "length_mm": 110.0, "yoke_thickness_mm": yoke_mm}
    geometry = stator({"shape": "none", "count": 12}, core=core, winding=None, frame=None, machine=None)
    cells = dict(uniform(1).cells) | {"yoke": 2, "core": 6, "slot": 1, "tooth": 1, "radial": 1}
    mesh = mesh_step(geometry.step(("stack",)), MeshDensity(cells))
    hooke = TransverselyIsotropic(186e9, 60e9, 0.29, 0.25, shear_pa).hooke()
    solution = solve_free(assemble(mesh), {"lamination": Material(hooke, 7700.0)}, 8000.0, (2, 3))
    named = {}
    for mode in solution.modes:
        if mode.order is not None and mode.axial is not None:
            named.setdefault((mode.order, mode.axial), mode)
    assert sheets_slide({name: mode.frequency_hz for name, mode in named.items()}) is slides
    grid, antisymmetric = shape_grid(mesh), [name for name in named if name[1] == 1]
    assert (2, 1) in antisymmetric
    for name in antisymmetric:
        motion = surface_motion(grid, solution, named[name])[:, 0]
        slope = np.gradient(motion[:, 0], grid.planes)
        length = -float(motion[:, 2] @ slope) / float(slope @ slope)
        lever = axial_lever(*name, mesh.outer_radius, slides)
        assert abs(length - lever.length_m) < 2.1 * lever.sd_m
