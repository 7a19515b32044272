"""A study to start from."""

from __future__ import annotations

from pathlib import Path

from statorhom.errors import InputFileError
from statorhom.study.atomic import write_text

GEOMETRY = """\
schema = 1
name = "my machine"

[core]
outer_diameter_mm = 120.0
bore_diameter_mm = 70.0
length_mm = 80.5
yoke_thickness_mm = 9.15          # radial, from the slot bottom to the back of the core

[slots]
count = 36
shape = "parallel_tooth"          # or semi_closed, round_bottom, parallel_slot, none
tooth_width_mm = 3.0

[winding]
overhang_length_mm = 25.0         # of each end
"""

STUDY = """\
schema = 1
name = "my-study"
geometry = "geometry.toml"

[[stages]]                        # one table a fabrication step, in their order
name = "stack"
kind = "stack"                    # stack | wound | impregnated | framed | machine
mass_kg = 3.08                    # of everything on the scale after this step
mass_sd_kg = 0.005
[stages.model]
lamination = "transversely_isotropic"   # isotropic | transversely_isotropic | orthotropic
[[stages.tests]]
name = "stack-free"
support = "free"
modal_table = "stack-free.csv"
"""

TABLE = """\
# One mode a row. Only frequency_hz is required; order is the circumferential order r, axial the number of axial
# node planes n. These figures are an example: write your own in their place.
frequency_hz,loss_factor,order,axial
1432,0.006,2,0
1766,0.007,2,1
3770,0.004,3,0
"""

FILES = {"geometry.toml": GEOMETRY, "study.toml": STUDY, "stack-free.csv": TABLE}


def write_template(folder: Path) -> list[Path]:
    """Write a study with explanations into a folder.

    Raises
    ------
    InputFileError
        If one of the files exists already; nothing is written then.
    """
    paths = [folder / name for name in FILES]
    for path in paths:
        if path.exists():
            raise InputFileError(f"{path}: exists already; choose another folder or remove it")
    for path, text in zip(paths, FILES.values(), strict=True):
        write_text(path, text)
    return paths
