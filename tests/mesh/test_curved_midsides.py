import numpy as np

from statorhom.mesh.curved_midsides import follow_boundary
from statorhom.mesh.quality import scaled_jacobians


def ring_grid(inner, outer, angle, radial, around, *, thinnest):
    """A grid of straight-sided cells of a sector, mid-sides on the arcs only at bore and back; thin inner layers."""
    r = inner + (outer - inner) * np.linspace(0.0, 1.0, radial + 1) ** thinnest
    t = np.linspace(0.0, angle, around + 1)
    corner = np.stack([r[:, None] * np.cos(t), r[:, None] * np.sin(t)], axis=-1)
    across, along = (corner[1:] + corner[:-1]) / 2, (corner[:, 1:] + corner[:, :-1]) / 2
    middle = (t[1:] + t[:-1]) / 2
    for k in (0, -1):
        along[k] = r[k] * np.column_stack([np.cos(middle), np.sin(middle)])
    points = np.concatenate([a.reshape(-1, 2) for a in (corner, across, along)])
    c = np.arange(corner[..., 0].size).reshape(corner.shape[:2])
    a = c.size + np.arange(across[..., 0].size).reshape(across.shape[:2])
    b = c.size + a.size + np.arange(along[..., 0].size).reshape(along.shape[:2])
    corners = [c[:-1, :-1], c[1:, :-1], c[1:, 1:], c[:-1, 1:]]
    return points, np.stack([*corners, a[:, :-1], b[1:], a[:, 1:], b[:-1]], axis=-1)


def test_a_thin_cell_beside_an_arc_is_no_longer_folded():
    points, grid = ring_grid(50.0, 60.0, np.radians(40.0), 4, 1, thinnest=2.0)
    assert scaled_jacobians(points, grid).min() < 0
    assert scaled_jacobians(follow_boundary(points, [grid]), grid).min() > 0.98


def test_inner_circles_bend_as_much_as_their_neighbours():
    points, grid = ring_grid(50.0, 60.0, np.radians(10.0), 4, 2, thinnest=1.0)
    moved = follow_boundary(points, [grid])
    radius = np.hypot(*moved[grid[..., 7]].T).T
    np.testing.assert_allclose(radius, np.hypot(*moved[grid[..., 0]].T).T, rtol=1e-6)


def test_sides_corners_and_straight_edges_stay():
    points, grid = ring_grid(50.0, 60.0, 0.3, 3, 2, thinnest=1.0)
    moved = follow_boundary(points, [grid])
    still = np.unique(
        np.concatenate([grid[..., :4].ravel(), grid[0, :, 7], grid[-1, :, 5], grid[..., 4].ravel()])
    )
    np.testing.assert_allclose(moved[still], points[still], atol=1e-12)
    assert np.abs(moved - points).max() > 1e-3
    assert not np.shares_memory(moved, points)


def test_a_grid_bends_alike_whichever_direction_comes_first():
    points, grid = ring_grid(50.0, 60.0, 0.5, 3, 2, thinnest=1.5)
    turned = grid.transpose(1, 0, 2)[:, :, [0, 3, 2, 1, 7, 6, 5, 4]]
    np.testing.assert_allclose(follow_boundary(points, [grid]), follow_boundary(points, [turned]), atol=1e-13)
