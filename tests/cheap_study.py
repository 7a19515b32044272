"""A study of two steps on a plain ring that is identified in a second or two."""

from __future__ import annotations

from pathlib import Path

from statorhom.identify.stages.settings import Settings
from statorhom.mesh.density import COARSEST, MeshDensity

GEOMETRY = """\
schema = 1
name = "ring"
[core]
outer_diameter_mm = 120.0
bore_diameter_mm = 90.0
length_mm = 60.0
yoke_thickness_mm = 15.0
[slots]
count = 8
shape = "none"
[frame]
inner_diameter_mm = 120.0
outer_diameter_mm = 128.0
length_mm = 60.0
offset_mm = 0.0
"""

STUDY = """\
schema = 1
name = "ring"
geometry = "ring.toml"

[[stages]]
name = "stack"
kind = "stack"
mass_kg = 2.313
[stages.model]
lamination = "isotropic"
[stages.identify]
evaluations = 60
chains = 1
[stages.identify.fixed.lamination]
nu = 0.3
[[stages.tests]]
name = "stack-free"
support = "free"
modal_table = "stack.csv"

[[stages]]
name = "framed"
kind = "framed"
mass_kg = 2.565
[stages.model]
frame = "isotropic"
[stages.identify]
evaluations = 60
chains = 1
[stages.identify.fixed.frame]
nu = 0.33
[[stages.tests]]
name = "framed-free"
support = "free"
modal_table = "framed.csv"
"""

STACK = """\
frequency_hz,loss_factor,order,axial
3090,0.004,2,0
4590,0.005,2,1
"""

FRAMED = """\
frequency_hz,loss_factor,order,axial
3600,0.01,2,0
5230,0.01,2,1
"""

FILES = {"study.toml": STUDY, "ring.toml": GEOMETRY, "stack.csv": STACK, "framed.csv": FRAMED}


def write_study(folder: Path) -> Path:
    """Write all files into a folder and return the study's path."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in FILES.items():
        (folder / name).write_text(text, encoding="utf-8")
    return folder / "study.toml"


def edit(path: Path, old: str, new: str, occurrence: int = 0) -> None:
    """Replace one occurrence of `old` in a file."""
    text = path.read_text(encoding="utf-8")
    assert text.count(old) > occurrence, f"{old!r} stands {text.count(old)} times in {path.name}"
    parts = text.split(old)
    head, tail = old.join(parts[: occurrence + 1]), old.join(parts[occurrence + 1 :])
    path.write_text(head + new + tail, encoding="utf-8")


def coarse(seed: int = 1, jobs: int = 1) -> Settings:
    """Settings of a run whose accuracy does not matter."""
    cells = COARSEST | {"core": 2, "yoke": 1}
    return Settings(seed=seed, jobs=jobs, density=MeshDensity(cells), refinements=(1.0, 1.5, 2.0))


def append(path: Path, text: str) -> None:
    """Add text at the end of a file, made where missing."""
    with path.open("a", encoding="utf-8") as file:
        file.write(text)
