import numpy as np
import pytest

from measured_points import Z_M, cylinder, dof
from statorhom.errors import IdentificationError
from statorhom.modes.point_layout import lay_out
from statorhom.recordings.dof import Dof

ANGLES = 2 * np.pi * np.arange(24) / 24


def test_a_grid_in_any_order_is_found():
    dofs = cylinder(ANGLES)
    mixed = [dofs[i] for i in np.random.default_rng(1).permutation(len(dofs))]
    (surface,) = lay_out(mixed).surfaces
    assert surface.z_m == pytest.approx(Z_M)
    assert surface.angles_rad == pytest.approx(ANGLES)
    for cell in surface.cells:
        (row,) = cell.rows
        assert mixed[row].position[2] == pytest.approx(Z_M[cell.plane])
        assert mixed[row].angle == pytest.approx(ANGLES[cell.column], abs=1e-9)


def test_points_marked_by_hand_make_the_same_grid():
    rng = np.random.default_rng(4)
    dofs = [
        dof(k, a + rng.uniform(-0.01, 0.01), z + rng.uniform(-5e-4, 5e-4), 0.06 + rng.uniform(-2e-4, 2e-4))
        for k, (z, a) in enumerate((z, a) for z in Z_M for a in ANGLES)
    ]
    (surface,) = lay_out(dofs).surfaces
    assert (surface.z_m.size, surface.angles_rad.size, len(surface.cells)) == (4, 24, 96)


def test_bore_and_frame_are_kept_apart_the_outer_one_first():
    dofs = [*cylinder(ANGLES, radius=0.035), *cylinder(ANGLES, radius=0.065), *cylinder(ANGLES, radius=0.06)]
    assert [round(s.radius_m, 6) for s in lay_out(dofs).surfaces] == [0.065, 0.06, 0.035]


def test_the_place_of_the_hammer_does_not_spoil_the_grid():
    layout = lay_out([*cylinder(ANGLES), dof(500, 0.1, Z_M[1])])
    assert layout.surfaces[0].angles_rad.size == 24
    assert any("beside the equidistant grid" in remark for remark in layout.remarks)


def test_what_has_no_place_is_said():
    layout = lay_out([*cylinder(ANGLES), Dof(900), dof(901, 0.0, 0.0, radius=0.0)])
    assert any("1 measured direction without" in remark for remark in layout.remarks)
    assert any("on the machine axis" in remark for remark in layout.remarks)
    with pytest.raises(IdentificationError, match="position and a direction"):
        lay_out([Dof(1), Dof(2)])
    with pytest.raises(IdentificationError):
        lay_out([])
