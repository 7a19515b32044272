"""A small valid study on disk that tests spoil in one place."""

from __future__ import annotations

from pathlib import Path

import pytest

GEOMETRY = """\
schema = 1
name = "small ring"
[core]
outer_diameter_mm = 120.0
bore_diameter_mm = 70.0
length_mm = 80.5
yoke_thickness_mm = 9.15
[slots]
count = 36
shape = "parallel_tooth"
tooth_width_mm = 3.0
[winding]
overhang_length_mm = 25.0
"""

STUDY = """\
schema = 1
name = "small"
geometry = "ring.toml"

[[supports]]
name = "clamped"
kind = "lines"
angles_deg = [158.0, 202.0]
declared = "rigid"

[[stages]]
name = "stack"
kind = "stack"
mass_kg = 3.08
[stages.model]
lamination = "transversely_isotropic"
[[stages.tests]]
name = "stack-free"
support = "free"
modal_table = "modes.csv"
[stages.identify]
chains = 2
[stages.identify.fixed.lamination]
nu_p = 0.3
[stages.identify.prior.lamination]
E_p_pa = { low = 1.5e11, high = 2.05e11 }

[[stages]]
name = "wound"
kind = "wound"
mass_kg = 4.36
mass_sd_kg = 0.002
[stages.model]
winding = "isotropic"
[[stages.tests]]
name = "wound-clamped"
support = "clamped"
frf = "wound.uff"
"""

TABLE = """\
# first resonances
mode,frequency_hz,damping_ratio,order,axial
1,1432,0.003,2,0
2,1766,0.0035,,
"""


class Folder:
    """The study's folder."""

    def __init__(self, root: Path) -> None:
        self.root = root
        self.study = root / "study.toml"
        self.geometry = root / "ring.toml"
        self.table = root / "modes.csv"
        self.study.write_text(STUDY, encoding="utf-8")
        self.geometry.write_text(GEOMETRY, encoding="utf-8")
        self.table.write_text(TABLE, encoding="utf-8")
        (root / "wound.uff").write_bytes(b"    -1\n")

    def edit(self, file: str, old: str, new: str) -> None:
        """Replace `old`, which must stand exactly once in the file."""
        path = self.root / file
        text = path.read_text(encoding="utf-8")
        assert text.count(old) == 1, f"{old!r} stands {text.count(old)} times in {file}"
        path.write_text(text.replace(old, new), encoding="utf-8")


@pytest.fixture
def folder(tmp_path: Path) -> Folder:
    return Folder(tmp_path)
