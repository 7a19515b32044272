"""Whole diagnoses of tubes whose truth is a finer whole mesh: what is named, where, and how large."""

import tomllib
from pathlib import Path

import numpy as np
import pytest

from concealed_tubes import STEEL, TYPED, Hidden, table, tube_modes, tube_recording, weight, write_tube
from statorhom import Study
from statorhom.results.diagnosis import Diagnosis, EffectResult, Estimated, Location

NOISE = 5e-4
SIDE = 0.014  # m, of a steel cube
CUBE_KG = SIDE**3 * STEEL.density
LUMP = Hidden(1.0, 0.09, mass_kg=CUBE_KG, foot=SIDE)
KNOWN = "[stages.identify.fixed.tube]\nE_pa = 205e9\nnu = 0.29\n"
TABLE = 'modal_table = "free.csv"'
LINES = np.arange(1500.0, 6000.0, 1.0)

pytestmark = pytest.mark.slow


def diagnosed(
    folder: Path, rows: str, *, mass_kg: float = weight(), identify: str = "", apply: bool = False
) -> Diagnosis:
    (folder / "free.csv").write_text(rows)
    study = write_tube(folder, TABLE, mass_kg=mass_kg, identify=identify)
    return Study.load(study).diagnose(folder / "out", apply=apply)


def value(effect: EffectResult, name: str) -> float:
    """Of a parameter; its interval holds it."""
    found = effect.parameters[name]
    assert isinstance(found, Estimated) and found.ci90 is not None
    assert found.ci90[0] < found.value < found.ci90[1]
    return found.value


def only(found: Diagnosis, name: str) -> EffectResult:
    """The one effect that is named."""
    assert found.verdict == "named"
    [effect] = found.effects
    assert effect.effect == name
    return effect


def test_an_even_tube_lacks_nothing(tmp_path: Path) -> None:
    found = diagnosed(tmp_path, table(tube_modes(), NOISE))
    assert found.verdict == "none"
    assert found.fit.before.rms_percent < 0.1


def test_a_lump_is_named_and_applied_and_the_tube_identified_with_it(tmp_path: Path) -> None:
    rows = table(tube_modes((LUMP,)), NOISE)
    found = diagnosed(tmp_path, rows, apply=True)
    lump = only(found, "attached_mass")
    assert value(lump, "mass_kg") == pytest.approx(CUBE_KG, rel=0.2)
    assert lump.region == "tube"
    # frequencies of a free ring tell no place
    assert lump.location is None
    # lines have 0.05 % of noise; the declared tube makes up for much of what a lump does to them, but not for all
    assert found.fit.after.rms_percent < 0.6 * found.fit.before.rms_percent
    assert found.fit.held_out is not None
    assert found.fit.held_out.after_rms_percent < 0.35 * found.fit.held_out.before_rms_percent
    out = tmp_path / "out"
    [stage] = tomllib.loads((out / "study.toml").read_text(encoding="utf-8"))["stages"]
    [effect] = stage["effects"]
    assert effect["effect"] == "attached_mass"
    moduli = [Study.read(at).stages[0].regions["tube"].engineering["E_pa"] for at in (out, out / "amended")]
    errors = [abs(m.value / 205e9 - 1) for m in moduli]
    assert errors[1] < min(0.01, errors[0])
    assert "Material of a tube, and what its model left out" in (out / "report.html").read_text()


def test_a_lump_is_placed_by_recordings(tmp_path: Path) -> None:
    tube_recording(tmp_path / "free.uff", tube_modes((LUMP,)), LINES, noise=3e-3)
    study = write_tube(tmp_path, 'frf = "free.uff"', mass_kg=weight())
    lump = only(Study.load(study).diagnose(tmp_path / "out"), "attached_mass")
    assert value(lump, "mass_kg") == pytest.approx(CUBE_KG, rel=0.2)
    place = lump.location
    assert isinstance(place, Location)
    assert place.angle_deg == pytest.approx(np.degrees(LUMP.angle), abs=3.0)
    assert place.z_mm == pytest.approx(1e3 * LUMP.z, abs=10.0)
    page = (tmp_path / "out" / "report.html").read_text()
    assert "What the model of a tube left out" in page
    assert f"at {place.angle_deg:.0f}°" in page


def test_a_stiff_suspension_is_named_with_its_stiffness(tmp_path: Path) -> None:
    # as cords near the ends hold it
    springs = (Hidden(0.7, 0.012, stiffness=1.5e6), Hidden(0.7, 0.108, stiffness=1.5e6))
    held = only(diagnosed(tmp_path, table(tube_modes(springs), NOISE)), "suspension_stiffness")
    assert value(held, "stiffness_n_per_m") == pytest.approx(3e6, rel=0.2)


def test_a_wrong_weight_of_a_tube_of_known_material_is_named(tmp_path: Path) -> None:
    rows = table(tube_modes(), NOISE)
    weighed = only(diagnosed(tmp_path, rows, mass_kg=1.04 * weight(), identify=KNOWN), "wrong_input")
    assert weighed.parameters["input"] == "mass_kg"
    assert value(weighed, "value") == pytest.approx(weight(), rel=5e-3)


def test_a_wrong_weight_of_a_tube_of_any_material_cannot_be_told(tmp_path: Path) -> None:
    """It scales the moduli alone."""
    found = diagnosed(tmp_path, table(tube_modes(), NOISE), mass_kg=1.04 * weight())
    assert found.verdict == "none"


@pytest.mark.parametrize("identify", [KNOWN, ""], ids=["known material", "any material"])
def test_a_wrong_wall_is_a_wrong_diameter(tmp_path: Path, identify: str) -> None:
    true = TYPED.model_copy(update={"inner_diameter_mm": 88.6})
    rows = table(tube_modes(keys=true), NOISE)
    found = diagnosed(tmp_path, rows, mass_kg=weight(true), identify=identify)
    wall = only(found, "wrong_input")
    assert wall.parameters["input"] == "inner_diameter_mm"
    assert value(wall, "value") == pytest.approx(88.6, abs=0.1)
    assert found.fit.after.rms_percent < 0.1 * found.fit.before.rms_percent


def test_a_heavy_roving_accelerometer_is_named_with_its_mass(tmp_path: Path) -> None:
    mass = 0.002
    tube_recording(tmp_path / "free.uff", tube_modes(), LINES, sensor_kg=mass, noise=3e-3)
    study = write_tube(tmp_path, 'frf = "free.uff"', mass_kg=weight())
    sensor = only(Study.load(study).diagnose(tmp_path / "out"), "sensor_mass")
    assert value(sensor, "mass_kg") == pytest.approx(mass, rel=0.2)
