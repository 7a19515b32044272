"""Whole diagnoses of plates whose truth is a finer whole mesh: what is named, where, and how large."""

import tomllib
from pathlib import Path

import numpy as np
import pytest
from body_studies import MASS_KG, holds, write_plate

from concealed_coupons import CLOTH, SIZE, Hidden, Patch, plate_frequencies, plate_recording
from statorhom import Study
from statorhom.model.affine import Material
from statorhom.results.diagnosis import Diagnosis, PlanLocation

pytestmark = pytest.mark.slow
MODES, TOP = 15, 2000.0
LINES = np.arange(100.0, 1000.0, 0.5)


def diagnosed(
    folder: Path, hidden: list[Hidden], *, identify: str = "", apply: bool = False
) -> tuple[Diagnosis, list[tuple[float, float]]]:
    frequencies, places = plate_frequencies(TOP, hidden, factor=1.3)
    study = write_plate(folder, frequencies[frequencies > 120.0][:MODES], identify=identify)
    return Study.load(study).diagnose(folder / "out", apply=apply), places


TRUE = {"E_1_pa": 60e9, "E_2_pa": 22e9, "G_12_pa": 7e9}
NARROW = """\
[stages.identify.fixed.plate]
E_3_pa = 11e9
nu_12 = 0.28
nu_13 = 0.3
nu_23 = 0.3
G_13_pa = 4.5e9
G_23_pa = 4e9
"""
KNOWN = NARROW + "".join(f"{name} = {value!r}\n" for name, value in TRUE.items())


def test_an_even_plate_lacks_nothing(tmp_path: Path) -> None:
    found, _ = diagnosed(tmp_path, [])
    assert found.verdict == "none"
    assert found.fit.before.rms_percent < 0.1


def test_a_lump_is_named_with_its_mass_and_its_mirrored_places(tmp_path: Path) -> None:
    mass = 0.025 * MASS_KG
    found, [(x, y)] = diagnosed(tmp_path, [Hidden(0.22, 0.13, mass_kg=mass)])
    assert found.verdict == "named"
    [effect] = found.effects
    assert effect.effect == "attached_mass"
    place = effect.location
    assert holds(effect.parameters["mass_kg"], mass)
    assert isinstance(place, PlanLocation)
    # frequencies do not tell which quarter
    assert len(place.place_ambiguity_mm) == 4
    nearest = min(np.hypot(a - 1e3 * x, b - 1e3 * y) for a, b in place.place_ambiguity_mm)
    assert nearest < 3.0
    assert found.fit.after.rms_percent < 0.2 * found.fit.before.rms_percent
    assert "equally possible" in (tmp_path / "out" / "report.html").read_text()


def test_a_named_lump_is_applied_and_the_plate_identified_with_it(tmp_path: Path) -> None:
    lump = Hidden(0.22, 0.13, mass_kg=0.025 * MASS_KG)
    diagnosed(tmp_path, [lump], identify="evaluations = 400\n" + NARROW, apply=True)
    out = tmp_path / "out"
    [stage] = tomllib.loads((out / "study.toml").read_text(encoding="utf-8"))["stages"]
    [effect] = stage["effects"]
    assert effect["effect"] == "attached_mass"
    assert {"mass_kg", "x_mm", "y_mm"} <= set(effect)
    errors = []
    for folder in (out, out / "amended"):
        found = Study.read(folder).stages[0].regions["plate"].engineering
        errors.append(max(abs(found[name].value / true - 1) for name, true in TRUE.items()))
    assert errors[1] < min(0.02, 0.5 * errors[0])


def test_a_stiff_suspension_is_named_with_its_stiffness(tmp_path: Path) -> None:
    half = Hidden(0.03, 0.05, stiffness=1e4), Hidden(0.27, 0.05, stiffness=1e4)
    found, _ = diagnosed(tmp_path, list(half))
    assert found.verdict == "named"
    [effect] = found.effects
    assert effect.effect == "suspension_stiffness"
    assert holds(effect.parameters["stiffness_n_per_m"], 2e4)


def test_a_flaw_that_makes_a_plate_unsymmetric_is_named_with_its_places(tmp_path: Path) -> None:
    flaw = Patch((0.185, 0.255), (0.105, 0.155), 0.75)
    frequencies, _ = plate_frequencies(TOP, factor=1.3, patch=flaw)
    found = Study.load(write_plate(tmp_path, frequencies[:MODES])).diagnose(tmp_path / "out")
    assert found.verdict == "named"
    [effect] = found.effects
    assert effect.effect == "local_stiffness"
    assert effect.parameters["stiffness_ratio"].value < 0.8  # type: ignore[union-attr]
    place = effect.location
    assert isinstance(place, PlanLocation)
    nearest = min(np.hypot(x - 220.0, y - 130.0) for x, y in place.place_ambiguity_mm)
    assert nearest < 15.0
    assert found.fit.after.rms_percent < 0.5 * found.fit.before.rms_percent


def test_a_wrong_thickness_of_a_plate_of_known_material_is_a_wrong_input(tmp_path: Path) -> None:
    thicker = 1.04
    size = (SIZE[0], SIZE[1], thicker * SIZE[2])
    # of the weight that was found
    material = Material(CLOTH.hooke, CLOTH.density / thicker)
    frequencies, _ = plate_frequencies(TOP, material=material, size=size, factor=1.3)
    study = write_plate(tmp_path, frequencies[:MODES], identify=KNOWN)
    found = Study.load(study).diagnose(tmp_path / "out")
    assert found.verdict == "named"
    [effect] = found.effects
    assert effect.effect == "wrong_input"
    assert found.fit.after.rms_percent < 0.1 * found.fit.before.rms_percent


def test_a_heavy_roving_accelerometer_is_named_with_its_mass(tmp_path: Path) -> None:
    mass = 0.0005
    plate_recording(tmp_path / "free.uff", LINES, mass, factor=1.3, noise=3e-3)
    study = write_plate(tmp_path, np.array([1.0]))
    study.write_text(study.read_text().replace('modal_table = "free.csv"', 'frf = "free.uff"'))
    found = Study.load(study).diagnose(tmp_path / "out")
    assert found.verdict == "named"
    [effect] = found.effects
    assert effect.effect == "sensor_mass"
    assert holds(effect.parameters["mass_kg"], mass)
