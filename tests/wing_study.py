"""Studies of wings on disk."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from statorhom.geometry.tested_object import object_geometry
from statorhom.geometry.wing import WingGeometry
from statorhom.identify.stages.stage_setup import stage_setup
from statorhom.materials.isotropic import Isotropic
from statorhom.materials.orthotropic import Orthotropic
from statorhom.mesh.wing import wing_mesh
from statorhom.model.affine import Material, assemble
from statorhom.model.free_modes import solve_free
from statorhom.study.study import load_study
from statorhom.study.wing_file import LUMPS

# one ply on thick webs: few cells, so that whole commands take seconds
SMALL_WING = """\
schema = 1
kind = "wing"
name = "a small wing"
[wing]
span_mm = 800.0
root_chord_mm = 300.0
tip_chord_mm = 200.0
sweep_deg = 10.0
spars_percent = [30.0, 70.0]
heights_percent = [8.0, 12.0, 9.0, 4.0]
web_thickness_mm = 4.0
web_material = "foam"
[[wing.plies]]
material = "cloth"
angle_deg = 45.0
thickness_mm = 2.5
[[wing.lumps]]
name = "fin"
mass_g = 15.0
x_mm = 200.0
y_mm = 390.0
[wing.density_kg_m3]
foam = 80.0
"""
SMALL_STUDY = """\
schema = 1
name = "small-wing"
geometry = "object.toml"
[[stages]]
name = "wing"
kind = "coupon"
mass_kg = 1.9
mass_sd_kg = 0.002
[stages.model.wing]
cloth = "orthotropic"
foam = "isotropic"
[[stages.tests]]
name = "free"
support = "free"
modal_table = "free.csv"
[stages.identify]
evaluations = 60
chains = 1
tied.cloth = [["E_1_pa", "E_2_pa"]]
[stages.identify.prior.cloth]
E_1_pa = { low = 25e9, high = 85e9 }
E_2_pa = { low = 25e9, high = 85e9 }
G_12_pa = { low = 1e9, high = 10e9 }
[stages.identify.fixed]
cloth = { E_3_pa = 9e9, nu_12 = 0.04, nu_13 = 0.3, nu_23 = 0.3, G_13_pa = 3e9, G_23_pa = 3e9 }
foam = { E_pa = 60e6, nu = 0.3 }
"""


def write_wing(
    folder: Path, geometry: str = SMALL_WING, study: str = SMALL_STUDY, table: str = "150\n300\n"
) -> Path:
    """Write geometry, study and modal table; returns the study's path."""
    (folder / "object.toml").write_text(geometry, encoding="utf-8")
    (folder / "free.csv").write_text(f"frequency_hz\n{table}", encoding="utf-8")
    path = folder / "study.toml"
    path.write_text(study, encoding="utf-8")
    return path


CLOTH = Orthotropic(47.126e9, 47.126e9, 9e9, 0.04, 0.3, 0.3, 3.927e9, 3e9, 3e9)  # the printed E and G
FOAM = Isotropic(60e6, 0.3)


def wing_frequencies(
    study: Path, constants: Mapping[str, Isotropic | Orthotropic], highest_hz: float, factor: float
) -> np.ndarray:
    """Natural frequencies (Hz) of the free wing of a study, of given materials, on a mesh of its own."""
    files = load_study(study)
    setup = stage_setup(files, object_geometry(files.drawing, files.geometry_path), 0)
    assert isinstance(setup.step, WingGeometry)
    materials = {
        name: Material(material.hooke(), setup.densities[name].density_kg_m3)
        for name, material in constants.items()
    }
    if setup.step.lumps:
        materials[LUMPS] = Material(materials[setup.step.regions[0]].hooke, 1.0)
    found = solve_free(assemble(wing_mesh(setup.step, factor)), materials, highest_hz)
    return np.array([mode.frequency_hz for mode in found.modes])
