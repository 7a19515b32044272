"""A ring whose concealed studies are made in a second, and cases of every kind of test without any solution."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from statorhom.conceal.start import start_case
from statorhom.conceal.truth import Case
from statorhom.mesh import uniform
from statorhom.mesh.density import COARSEST, MeshDensity
from statorhom.study.geometry_file import GeometryFile
from statorhom.study.study_file import StudyFile
from statorhom.study.toml_text import toml_text

COARSE = MeshDensity(dict(COARSEST) | {"core": 2})
ANY_MESH = uniform()
RING = {
    "schema": 1,
    "name": "ring",
    "core": {
        "outer_diameter_mm": 120.0,
        "bore_diameter_mm": 90.0,
        "length_mm": 60.0,
        "yoke_thickness_mm": 15.0,
    },
    "slots": {"shape": "none", "count": 12},
}
SLOTTED = {
    **RING,
    "name": "slotted",
    "core": {
        "outer_diameter_mm": 120.0,
        "bore_diameter_mm": 70.0,
        "length_mm": 80.5,
        "yoke_thickness_mm": 9.15,
    },
    "slots": {"shape": "parallel_tooth", "count": 12, "tooth_width_mm": 9.0},
    "winding": {"overhang_length_mm": 25.0},
    "frame": {
        "inner_diameter_mm": 120.0,
        "outer_diameter_mm": 130.0,
        "length_mm": 120.0,
        "offset_mm": -19.75,
    },
}
CLAMP = {"name": "clamped", "kind": "lines", "angles_deg": [158.0, 202.0], "declared": "rigid"}


def free_test(name: str, *, is_table: bool) -> dict[str, object]:
    """Keys of a free test; its data need not exist."""
    return {"name": name, "support": "free", ("modal_table" if is_table else "frf"): "-"}


def stage(kind: str, tests: list[dict[str, object]], mass_kg: float) -> dict[str, object]:
    """Keys of a stage."""
    region = {"stack": "lamination", "framed": "frame"}.get(kind, "winding")
    model = {region: "isotropic" if kind == "framed" else "transversely_isotropic"}
    return {
        "name": kind,
        "kind": kind,
        "mass_kg": mass_kg,
        "mass_sd_kg": 0.002,
        "model": model,
        "tests": tests,
    }


def study_keys(stages: list[dict[str, object]], **keys: object) -> dict[str, object]:
    """A study file."""
    return {"schema": 1, "name": "ring", "geometry": "geometry.toml", **keys, "stages": stages}


def write_ring(folder: Path, *, is_table: bool = True) -> Path:
    """A study of the free ring, without data; its path."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "geometry.toml").write_text(toml_text(RING), encoding="utf-8")
    keys = study_keys([stage("stack", [free_test("stack-free", is_table=is_table)], 2.3)])
    (folder / "template.toml").write_text(toml_text(keys), encoding="utf-8")
    return folder / "template.toml"


def full_case(seed: int = 1) -> Case:
    """A slotted stator in all steps up to the frame, with tables, FRFs, force levels and a clamp."""
    levels = [{**free_test(f"level-{f:g}", is_table=False), "force_level_n": f} for f in (2.0, 20.0)]
    clamped = {"name": "clamped-test", "support": "clamped", "frf": "-"}
    stages = [
        stage("stack", [*levels, free_test("stack-table", is_table=True), clamped], 1.0),
        stage("wound", [free_test("wound-table", is_table=True)], 2.0),
        stage("impregnated", [free_test("impregnated-frf", is_table=False)], 3.0),
        stage("framed", [free_test("framed-table", is_table=True)], 4.0),
    ]
    study = StudyFile.model_validate(study_keys(stages, supports=[CLAMP]))
    geometry = GeometryFile.model_validate(SLOTTED)
    return start_case(Path("study.toml"), study, geometry, np.random.default_rng(seed))
