"""Names of plates', beams' and wings' shapes: exact ones, noisy ones, and those of a full model."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import brentq

from statorhom.errors import IdentificationError
from statorhom.modes.plan_form import name_plan_form, ordinal_labels


def free_beam(nodes: int, x: np.ndarray) -> np.ndarray:
    """Shape of a free beam on −1 … 1; 0 and 1 nodes are its rigid motions."""
    if nodes < 2:
        return x**nodes
    rough = (nodes - 0.5) * np.pi / 2
    if nodes % 2 == 0:
        k = brentq(lambda b: np.tan(b) + np.tanh(b), rough - 0.3, rough + 0.3)
        return np.cos(k * x) / np.cos(k) + np.cosh(k * x) / np.cosh(k)
    k = brentq(lambda b: np.tan(b) - np.tanh(b), rough - 0.3, rough + 0.3)
    return np.sin(k * x) / np.sin(k) + np.sinh(k * x) / np.sinh(k)


def plate(columns: int = 9, rows: int = 5) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Points of a plate of 300 × 200, and their −1 … 1 coordinates."""
    x, y = (one.ravel() for one in np.meshgrid(np.linspace(-1, 1, columns), np.linspace(-1, 1, rows)))
    return np.column_stack([150 * x, 100 * y, 0 * x]), x, y


def wing(count: int = 94, seed: int = 1) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Scattered points of a swept, tapered wing with its tips at ±0.95 m; span and local chord −1 … 1."""
    rng = np.random.default_rng(seed)
    edge = np.repeat([-1.0, 1.0], count // 3)
    span = np.concatenate([np.linspace(-1, 1, count // 3)] * 2 + [rng.uniform(-1, 1, count - len(edge))])
    chord = np.concatenate([edge, rng.uniform(-0.8, 0.8, count - len(edge))])
    width = 0.35 - 0.2 * np.abs(span)
    y = 0.3 * np.abs(span) + chord * width / 2
    return np.column_stack([0.95 * span, y, 0.01 * np.cos(chord)]), span, chord


def normal(values: np.ndarray) -> np.ndarray:
    return np.column_stack([0 * values, 0 * values, values])


@pytest.mark.parametrize(
    ("i", "j", "kind", "symmetry"),
    [
        (2, 0, "bending", "symmetric"),
        (3, 0, "bending", "antisymmetric"),
        (4, 0, "bending", "symmetric"),
        (1, 1, "torsion", "antisymmetric"),
        (2, 1, "torsion", "symmetric"),
        (0, 2, "chordwise bending", "symmetric"),
        (1, 2, "chordwise bending", "antisymmetric"),
        (2, 2, "chordwise bending", "symmetric"),
    ],
)
@pytest.mark.parametrize("body", [plate, wing])
def test_nodal_lines_of_free_plates_and_wings(body, i, j, kind, symmetry) -> None:
    points, x, y = body()
    rng = np.random.default_rng(3)
    shape = free_beam(i, x) * free_beam(j, y)
    shape += 0.05 * np.abs(shape).max() * rng.standard_normal(len(shape))
    name = name_plan_form(points, normal(shape) * np.exp(0.7j))
    assert (name.kind, name.span_nodes, name.chord_nodes) == (kind, i, j)
    assert name.symmetry == symmetry
    assert name.out_of_plane > 0.999


@pytest.mark.parametrize(("i", "j"), [(1, 1), (2, 1), (1, 2), (3, 2)])
def test_half_waves_of_a_supported_plate_are_one_more(i: int, j: int) -> None:
    points, x, y = plate(13, 9)
    name = name_plan_form(points, normal(np.sin(i * np.pi * (x + 1) / 2) * np.sin(j * np.pi * (y + 1) / 2)))
    assert (name.span_nodes, name.chord_nodes) == (i - 1, j - 1)


def test_a_turned_body_has_the_same_name() -> None:
    points, x, y = wing()
    turn = np.linalg.qr(np.random.default_rng(7).standard_normal((3, 3)))[0]
    motion = normal(free_beam(2, x) * y)
    name = name_plan_form(points @ turn.T + 5.0, motion @ turn.T)
    assert (name.kind, name.span_nodes, name.symmetry) == ("torsion", 2, "symmetric")


def test_a_clamped_wing_has_no_symmetry() -> None:
    points, x, y = wing()
    half = x > 0
    bending = name_plan_form(points[half], normal(1 - np.cos(np.pi * x[half] / 2)))
    torsion = name_plan_form(points[half], normal(np.sin(np.pi * x[half] / 2) * y[half]))
    assert (bending.kind, bending.span_nodes, bending.symmetry) == ("bending", 0, None)
    assert (torsion.kind, torsion.span_nodes) == ("torsion", 0)


def test_rigid_bodies_are_none_of_these() -> None:
    points, x, y = wing()
    for motion in (1 + 0 * x, x, y * (0.35 - 0.2 * np.abs(x)) + 0.6 * np.abs(x)):
        name = name_plan_form(points, normal(motion))
        assert name.kind == "rigid body" and name.span_nodes is None
    spun = np.cross([0.0, 0.0, 1.0], points)
    assert name_plan_form(points, spun).kind == "rigid body"


def test_motion_in_the_plane() -> None:
    points, x, y = plate()
    bent = np.column_stack([-0.3 * y * np.gradient(free_beam(2, x)), free_beam(2, x), 0.1 * x])
    name = name_plan_form(points, bent)
    assert (name.kind, name.span_nodes) == ("in-plane bending", 2)
    assert name.out_of_plane < 0.1
    stretched = np.column_stack([np.sin(np.pi * x / 2), 0 * x, 0 * x])
    assert name_plan_form(points, stretched).kind == "axial"


def test_points_on_a_line_tell_bending_alone() -> None:
    x = np.linspace(-1, 1, 11)
    points = np.column_stack([300 * x, 0 * x, 0 * x])
    name = name_plan_form(points, normal(free_beam(3, x)), axes=np.eye(3))
    assert (name.kind, name.span_nodes, name.chord_nodes) == ("bending", 3, 0)


def test_shapes_beyond_the_points_have_no_name() -> None:
    points = plate(4, 3)[0]
    assert name_plan_form(points, normal(np.array([1.0, -1.0, 1.0, -1.0] * 3))).kind is None
    noise = np.random.default_rng(0).standard_normal(45)
    assert name_plan_form(plate()[0], normal(noise)).kind is None


def test_a_mixture_is_not_named() -> None:
    """The (2, 0) and (0, 2) modes of a square plate mix half and half."""
    _, x, y = plate(9, 9)
    points = np.column_stack([100 * x, 100 * y, 0 * x])
    name = name_plan_form(points, normal(free_beam(2, x) - free_beam(2, y)), axes=np.eye(3))
    assert name.kind is None or name.share < 0.6


def test_modes_of_a_kind_are_counted() -> None:
    points, x, y = wing()
    shapes = [free_beam(2, x), free_beam(3, x), free_beam(1, x) * y, free_beam(4, x), 1 + 0 * x]
    labels = ordinal_labels([name_plan_form(points, normal(shape)) for shape in shapes])
    assert labels == ("1st bending", "2nd bending", "1st torsion", "3rd bending", "1st rigid body")


@pytest.mark.parametrize(
    ("points", "motion", "words"),
    [
        (np.zeros((3, 3)), np.ones((3, 3)), "four points"),
        (np.zeros((5, 3)), np.ones((5, 3)), "one station"),
        (np.eye(4)[:, :3], np.zeros((4, 3)), "does not move"),
        (np.zeros((5, 3)), np.ones((4, 3)), "must be"),
    ],
)
def test_what_has_no_name_is_one_clear_line(points, motion, words) -> None:
    with pytest.raises(IdentificationError, match=words):
        name_plan_form(points, motion)
