"""Tubes with something hidden: modes of whole meshes that the diagnosis, which knows one sector, has no part in."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import product
from pathlib import Path

import numpy as np
import scipy.sparse as sp

from coupon_study import study_text, write_study
from roving_sensor import loaded_accelerance
from statorhom.geometry.tube import tube_geometry
from statorhom.materials.isotropic import Isotropic
from statorhom.mesh.density import COARSEST, MeshDensity
from statorhom.mesh.extrude import mesh_step
from statorhom.model.affine import Material
from statorhom.model.general.general_model import GeneralModel, whole_ring
from statorhom.recordings.dof import Dof
from statorhom.recordings.frf_set import FrfSet
from statorhom.recordings.recording import Node, Recording
from statorhom.recordings.uff.writer import write_uff
from statorhom.study.coupon_file import TubeKeys

TYPED = TubeKeys(outer_diameter_mm=100.0, inner_diameter_mm=88.0, length_mm=120.0)
STEEL = Material(Isotropic(205e9, 0.29).hooke(), 7850.0)
# 14 cells along, where the fitting mesh has four, and errors below 5e-4 in all modes of the band
FINE = MeshDensity({**COARSEST, "core": 14}, end_grading=3.0)
TOP_HZ = 10000.0
RIGID_HZ = 50.0
MOVING = 0.2  # radial motion of the outside over all motion: less of it has no name (r, n)


@dataclass(frozen=True)
class Hidden:
    """A cube (kg) on a square foot (m) or a radial spring (N/m), outside at an angle (rad) and a height (m)."""

    angle: float
    z: float
    mass_kg: float = 0.0
    stiffness: float = 0.0
    foot: float = 0.014


@dataclass(frozen=True, eq=False)
class TubeModes:
    """Elastic modes: frequencies (Hz), names (r, n) or None, and unit modal mass motions (modes, angles, levels, 3)."""

    frequencies: np.ndarray
    names: tuple[tuple[int, int] | None, ...]
    motion: np.ndarray
    angles: np.ndarray
    z: np.ndarray


def weight(keys: TubeKeys = TYPED, density: float = STEEL.density) -> float:
    """Mass (kg) of a tube."""
    area = np.pi / 4 * (keys.outer_diameter_mm**2 - keys.inner_diameter_mm**2)
    return float(density * area * keys.length_mm * 1e-9)


@lru_cache(maxsize=4)
def whole_tube(sizes: tuple[float, float, float]) -> GeneralModel:
    """The whole tube's mesh (outer and inner diameter, length in mm), no symmetry used."""
    outer, inner, length = sizes
    keys = TubeKeys(outer_diameter_mm=outer, inner_diameter_mm=inner, length_mm=length)
    return whole_ring(mesh_step(tube_geometry(keys, "test").step(("coupon",)), FINE))


@lru_cache(maxsize=4)
def tube_modes(hidden: tuple[Hidden, ...] = (), *, keys: TubeKeys = TYPED) -> TubeModes:
    """Modes of a free tube with what is hidden on it."""
    model = whole_tube((keys.outer_diameter_mm, keys.inner_diameter_mm, keys.length_mm))
    radius = keys.outer_diameter_mm / 2e3
    changed = model
    for one in hidden:
        dofs, K, M = _attached(model, radius, one)
        places = np.repeat(dofs, len(dofs)), np.tile(dofs, len(dofs))
        added = [sp.csr_array((A.ravel(), places), shape=(model.size, model.size)) for A in (K, M)]
        changed = changed.with_added(*added)
    found = changed.solve(TOP_HZ, {"tube": STEEL})
    elastic = found.frequencies_hz > RIGID_HZ
    grid, angles, z = _outside(model, radius)
    shapes = found.vectors.T.reshape(len(found.eigenvalues), -1, 3)[elastic]
    motion = shapes[:, grid]
    names = tuple(_name(m, float(np.abs(s).max())) for m, s in zip(motion, shapes, strict=True))
    return TubeModes(found.frequencies_hz[elastic], names, motion, angles, z)


def _attached(model: GeneralModel, radius: float, one: Hidden) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Displacements under a foot, and the stiffness and mass between them."""
    found = []
    for u, v in product((-0.5, 0.0, 0.5), repeat=2):
        angle = one.angle + u * one.foot / radius
        at = [radius * np.cos(angle), radius * np.sin(angle), one.z + v * one.foot]
        found.append(int(np.argmin(np.linalg.norm(model.mesh.nodes - at, axis=1))))
    nodes = np.unique(found)
    centre = np.array([radius * np.cos(one.angle), radius * np.sin(one.angle), one.z])
    # the foot follows the mean motion and rotation of its nodes, the cube is rigid
    parts = []
    for x in model.mesh.nodes[nodes]:
        t = np.arctan2(x[1], x[0])
        axes = np.array([[np.cos(t), np.sin(t), 0.0], [-np.sin(t), np.cos(t), 0.0], [0.0, 0.0, 1.0]])
        parts.append(axes @ _rigid(x - centre))
    mean = np.linalg.pinv(np.concatenate(parts))
    out = np.array([np.cos(one.angle), np.sin(one.angle), 0.0])
    middle = _rigid(one.foot / 2 * out)
    mass = one.mass_kg * middle.T @ middle
    mass[3:, 3:] += one.mass_kg * one.foot**2 / 6 * np.eye(3)
    stiffness = np.zeros((6, 6))
    stiffness[:3, :3] = one.stiffness * np.outer(out, out)
    dofs = (3 * nodes[:, None] + np.arange(3)).ravel()
    return dofs, mean.T @ stiffness @ mean, mean.T @ mass @ mean


def _rigid(position: np.ndarray) -> np.ndarray:
    """Motion (3, 6) of a point under three translations and three small rotations about the origin."""
    a, b, c = position
    return np.hstack([np.eye(3), [[0.0, c, -b], [-c, 0.0, a], [b, -a, 0.0]]])


def _outside(model: GeneralModel, radius: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Nodes (angles, levels) of the outside where all angles have all levels, with angles (rad) and levels (m)."""
    nodes = model.mesh.nodes
    outer = np.flatnonzero(np.hypot(nodes[:, 0], nodes[:, 1]) > (1 - 1e-6) * radius)
    turn = np.round(np.degrees(np.arctan2(nodes[outer, 1], nodes[outer, 0])) % 360.0, 6) % 360.0
    # corner nodes alone: every 5°, whole cells along
    own = outer[np.abs(turn / 5.0 - np.round(turn / 5.0)) < 1e-4]
    turn = np.round(np.degrees(np.arctan2(nodes[own, 1], nodes[own, 0])) / 5.0).astype(int) % 72
    level = np.round(nodes[own, 2], 9)
    z = np.unique(level)
    grid = np.full((72, len(z)), -1)
    grid[turn, np.searchsorted(z, level)] = own
    assert np.all(grid >= 0)
    return grid, np.arange(72) * np.pi / 36, z


def _name(motion: np.ndarray, largest: float) -> tuple[int, int] | None:
    """(r, n) by the largest wave of the radial motion and its changes of sign along the tube."""
    waves = np.fft.rfft(motion[..., 0], axis=0)
    order = int(np.argmax(np.sum(np.abs(waves) ** 2, axis=1)))
    if order < 2 or np.abs(motion[..., 0]).max() < MOVING * largest:
        return None
    wave = waves[order]
    along = np.real(wave * np.exp(-0.5j * np.angle(np.sum(wave**2))))
    signs = np.sign(along[np.abs(along) > 0.05 * np.abs(along).max()])
    return order, int(np.sum(signs[1:] != signs[:-1]))


def table(found: TubeModes, noise: float, seed: int = 0) -> str:
    """A modal table of the named modes, both members of every doublet, with relative noise on the frequencies."""
    rng = np.random.default_rng(seed)
    rows = ["frequency_hz,frequency_sd_hz,loss_factor,order,axial"]
    for frequency, name in zip(found.frequencies.tolist(), found.names, strict=True):
        if name is not None:
            measured = frequency * (1 + noise * rng.standard_normal())
            loss = 0.004 * (1 + 0.05 * rng.standard_normal())
            rows.append(f"{measured:.4f},{noise * frequency:.4f},{loss:.6f},{name[0]},{name[1]}")
    return "\n".join(rows) + "\n"


def write_tube(
    folder: Path, test: str, *, mass_kg: float, symmetry: str = "isotropic", identify: str = ""
) -> Path:
    """A study of the tube as it was typed; returns its path."""
    sizes = "".join(f"{key} = {value!r}\n" for key, value in TYPED.model_dump().items())
    drawing = f'schema = 1\nkind = "tube"\nname = "a tube"\n[tube]\n{sizes}'
    return write_study(folder, drawing, study_text("tube", symmetry, mass_kg, test, identify))


def tube_recording(
    path: Path,
    found: TubeModes,
    lines: np.ndarray,
    *,
    sensor_kg: float = 0.0,
    loss: float = 0.004,
    noise: float,
) -> None:
    """FRFs (universal file) of radial points around at five heights, hammer at one of them, with a sensor's mass."""
    chosen = [(6 * i, k) for k in np.linspace(0, len(found.z) - 1, 5).round().astype(int) for i in range(12)]
    moved = np.array([[mode[i, k] for i, k in chosen] for mode in found.motion])
    poles = [(f, loss) for f in found.frequencies.tolist()]
    exact = loaded_accelerance(lines, poles, moved, moved[:, 0, 0], sensor_kg)
    radius = TYPED.outer_diameter_mm / 2e3
    points = []
    for number, (i, k) in enumerate(chosen):
        c, s = np.cos(found.angles[i]), np.sin(found.angles[i])
        points.append(Dof(number + 1, (radius * c, radius * s, float(found.z[k])), (c, s, 0.0)))
    rng = np.random.default_rng(5)
    normal = rng.normal(size=(2, *exact.shape)) / np.sqrt(2)
    sd = np.hypot(noise * np.abs(exact), 3e-4 * np.abs(exact).max())
    hammer = (replace(points[0]),) * len(points)
    frfs = FrfSet(lines, tuple(points), hammer, exact + sd * (normal[0] + 1j * normal[1]))
    nodes = tuple(Node(p.node, p.position) for p in points if p.position is not None)
    write_uff(path, Recording("tube", frf_sets=(frfs,), nodes=nodes))
