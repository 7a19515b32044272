"""Studies of plates, beams and tubes on disk, with modal tables computed on finer meshes."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from scipy import signal

from statorhom.geometry.block import BlockGeometry
from statorhom.mesh.block import block_mesh
from statorhom.mesh.mirror_mesh import MirrorMesh
from statorhom.model.affine import Material, assemble
from statorhom.model.free_modes import solve_free

PLATE = """\
schema = 1
kind = "plate"
name = "a plate"
[plate]
length_mm = 300.0
width_mm = 200.0
thickness_mm = 4.0
"""
SIZE_M = (0.3, 0.2, 0.004)
BEAM = """\
schema = 1
kind = "beam"
name = "a beam"
[beam]
length_mm = 240.0
width_mm = 24.0
height_mm = 16.0
stack_axis = "z"
"""
TUBE = """\
schema = 1
kind = "tube"
name = "a tube"
[tube]
outer_diameter_mm = 100.0
inner_diameter_mm = 92.0
length_mm = 150.0
"""


def study_text(region: str, symmetry: str, mass_kg: float, test: str, identify: str = "") -> str:
    """A study file of one coupon stage."""
    return f"""\
schema = 1
name = "coupon"
geometry = "object.toml"
[[stages]]
name = "{region}"
kind = "coupon"
mass_kg = {mass_kg!r}
mass_sd_kg = {mass_kg * 1e-3!r}
[stages.model]
{region} = "{symmetry}"
[[stages.tests]]
name = "free"
support = "free"
{test}
[stages.identify]
{identify}
"""


def write_study(folder: Path, geometry: str, study: str) -> Path:
    """Write both files; returns the study's."""
    (folder / "object.toml").write_text(geometry, encoding="utf-8")
    path = folder / "study.toml"
    path.write_text(study, encoding="utf-8")
    return path


def block_frequencies(
    region: str, size_m: tuple[float, float, float], material: Material, highest_hz: float, factor: float
) -> np.ndarray:
    """Natural frequencies of a free block on a refined mesh."""
    model = assemble(block_mesh(BlockGeometry(region, size_m, "test"), factor))
    modes = solve_free(model, {region: material}, highest_hz).modes
    return np.array([mode.frequency_hz for mode in modes])


def table_text(frequencies: Sequence[float], noise: float, seed: int, damping: float = 0.004) -> str:
    """A modal table with relative Gaussian noise on the frequencies."""
    rng = np.random.default_rng(seed)
    rows = []
    for f in frequencies:
        measured, loss = f * (1 + noise * rng.standard_normal()), damping * (1 + 0.05 * rng.standard_normal())
        rows.append(f"{measured:.4f},{max(noise, 1e-4) * f:.4f},{loss:.6f}")
    return "frequency_hz,frequency_sd_hz,damping_ratio\n" + "\n".join(rows) + "\n"


RATE_HZ = 12800.0


def write_hits(
    folder: Path,
    block: BlockGeometry,
    material: Material,
    *,
    hammer_m: tuple[float, float, float],
    response_m: tuple[float, float, float],
    highest_hz: float,
    count: int = 4,
    damping_ratio: float = 0.004,
    noise: float = 1e-3,
) -> list[str]:
    """CSV files of hammer hits along z on a free block, by superposition of its elastic and rigid modes."""
    mesh = block_mesh(block, 1.5)
    model = assemble(mesh)
    free = solve_free(model, {block.region: material}, highest_hz)
    mass = material.density * float(np.prod(block.size))
    rows = [_vertical(mesh, place) for place in (hammer_m, response_m)]
    constants, naturals = [1.0 / mass], [0.5]
    for mode in free.modes:
        shape = free.shape(mode)
        there, here = (shape[row] * np.prod(mesh.signs(mode.parities or 0)[flips, 2]) for row, flips in rows)
        constants.append(float(there * here))
        naturals.append(mode.frequency_hz)
    names = []
    for number in range(count):
        name = f"hit-{number + 1}.csv"
        rng = np.random.default_rng(number)
        record = _hit(np.array(constants), np.array(naturals), damping_ratio, noise, rng)
        lines = [f"{t:.8f},{f:.6g},{a:.6g}" for t, f, a in record]
        (folder / name).write_text("time_s,force_n,acceleration_m_s2\n" + "\n".join(lines) + "\n")
        names.append(name)
    return names


def _vertical(mesh: MirrorMesh, place: tuple[float, float, float]) -> tuple[int, list[int]]:
    """Number of the z component of the part's node nearest to a place, and the planes that it is mirrored at."""
    image = np.array(place)
    flips = [i for i, (axis, position) in enumerate(mesh.mirrors) if image[axis] > position]
    for i in flips:
        axis, position = mesh.mirrors[i]
        image[axis] = 2 * position - image[axis]
    return 3 * int(np.argmin(np.linalg.norm(mesh.nodes - image, axis=1))) + 2, flips


def _hit(
    constants: np.ndarray, naturals: np.ndarray, ratio: float, noise: float, rng: np.random.Generator
) -> np.ndarray:
    """(samples, 3) time, force and acceleration; the force is linear between samples of four times the rate."""
    fine = 4 * RATE_HZ
    time = np.arange(round(1.0 * fine)) / fine
    phase = np.clip((time - 0.02 - rng.uniform(0, 1 / RATE_HZ)) / 3e-4, 0.0, 1.0)
    force = 80.0 * (0.5 - 0.5 * np.cos(2 * np.pi * phase))
    acceleration = np.zeros_like(force)
    for constant, natural in zip(constants, 2 * np.pi * naturals, strict=True):
        continuous = ([constant, 0.0, 0.0], [1.0, 2 * ratio * natural, natural**2])
        numerator, denominator, _ = signal.cont2discrete(continuous, 1 / fine, method="foh")
        acceleration += signal.lfilter(np.ravel(numerator), denominator, force)
    records = signal.decimate(np.vstack([force, acceleration]), 4, ftype="fir", zero_phase=True)
    size = noise * np.abs(records).max(axis=1, keepdims=True)
    records = records + size * rng.standard_normal(records.shape)
    return np.column_stack([np.arange(records.shape[1]) / RATE_HZ, records.T])
