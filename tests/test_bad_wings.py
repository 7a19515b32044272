"""Whatever is wrong with a wing's files: one line that says where and what to do, and exit code 2."""

from __future__ import annotations

from pathlib import Path

import pytest

from command import statorhom
from wing_study import SMALL_STUDY, SMALL_WING, write_wing

SURFACE = 'chains = 1\nmethod = "response_surface"\n'
FAULTS = {
    "a ply turned too far": (
        "geometry", "angle_deg = 45.0", "angle_deg = 95.0",
        ["object.toml: wing.plies[#1].angle_deg: must be at most 90", "correct the number"],
    ),
    "a ply of no thickness": (
        "geometry", "thickness_mm = 2.5", "thickness_mm = 0.0",
        ["object.toml: wing.plies[#1].thickness_mm: must be greater than 0", "correct the number"],
    ),
    "skins that fill the wing": (
        "geometry", "thickness_mm = 2.5", "thickness_mm = 5.0",
        ["object.toml: wing.heights_percent: leave no room", "correct the number"],
    ),
    "a lump beside the wing": (
        "geometry", "x_mm = 200.0", "x_mm = 900.0",
        ["object.toml: wing.lumps[fin]: lies off the wing", "correct the number"],
    ),
    "spars in the wrong order": (
        "geometry", "[30.0, 70.0]", "[70.0, 30.0]",
        ["object.toml: wing.spars_percent: must rise", "correct the number"],
    ),
    "a weight below its parts": (
        "study", "mass_kg = 1.9", "mass_kg = 0.04",
        ["study.toml: mass_kg: 0.04 kg after 'wing'", "parts of known mass", "correct this weight"],
    ),
    "an isotropic Poisson ratio of a half": (
        "study", "nu = 0.3 }", "nu = 0.5 }",
        ["study.toml: stages[wing].identify.fixed.foam.nu: 0.5 is no Poisson ratio", "below 0.5"],
    ),
    "Poisson ratios that no material has": (
        "study", "E_3_pa = 9e9, nu_12 = 0.04, nu_13 = 0.3", "E_3_pa = 900e9, nu_12 = 0.04, nu_13 = 0.99",
        ["study.toml: stages[wing].identify.fixed.cloth: no material has these constants", "correct them"],
    ),
    "a design with fewer points than coefficients": (
        "study", "chains = 1\n", SURFACE + 'response_surface = { points = 5, surface = "polynomial", degree = 3 }\n',
        ["study.toml: stages[wing].identify.response_surface: ", "5 points", "10 coefficients", "raise points"],
    ),
}  # fmt: skip


@pytest.mark.parametrize("command", ["fit", "run", "simulate"])
@pytest.mark.parametrize("fault", FAULTS)
def test_a_fault_is_one_line(fault: str, command: str, tmp_path: Path) -> None:
    if command == "simulate" and "design" in fault:
        pytest.skip("simulation needs no design")
    file, old, new, fragments = FAULTS[fault]
    texts = {"geometry": SMALL_WING, "study": SMALL_STUDY}
    assert old in texts[file]
    path = write_wing(tmp_path, **{file: texts[file].replace(old, new, 1)})
    outcome = statorhom(command, path, "--out", tmp_path / "out")
    assert outcome.code == 2 and outcome.stdout == ""
    (line,) = outcome.stderr.splitlines()
    for fragment in fragments:
        assert fragment in line
    assert list((tmp_path / "out").glob("*")) == []
