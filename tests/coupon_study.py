"""Studies of plates, beams and tubes on disk, with modal tables computed on finer meshes."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from statorhom.geometry.block import BlockGeometry
from statorhom.mesh.block import block_mesh
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
