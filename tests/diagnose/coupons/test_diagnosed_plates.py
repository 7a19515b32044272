"""Whole diagnoses of plates whose truth is a finer whole mesh: what is named, where, and how large."""

from pathlib import Path

import numpy as np
import pytest
from body_studies import MASS_KG, write_plate

from concealed_coupons import Hidden, plate_frequencies
from statorhom import Study
from statorhom.results.diagnosis import Diagnosis, Estimated, PlanLocation

pytestmark = pytest.mark.slow
MODES, TOP = 15, 2000.0


def diagnosed(folder: Path, hidden: list[Hidden]) -> tuple[Diagnosis, list[tuple[float, float]]]:
    frequencies, places = plate_frequencies(TOP, hidden, factor=1.3)
    study = write_plate(folder, frequencies[frequencies > 120.0][:MODES])
    return Study.load(study).diagnose(folder / "out"), places


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
    size, place = effect.parameters["mass_kg"], effect.location
    assert isinstance(size, Estimated)
    assert size.ci90 is not None
    assert size.ci90[0] < mass < size.ci90[1]
    assert isinstance(place, PlanLocation)
    # frequencies do not tell which quarter
    assert len(place.place_ambiguity_mm) == 4
    nearest = min(np.hypot(a - 1e3 * x, b - 1e3 * y) for a, b in place.place_ambiguity_mm)
    assert nearest < 3.0
    assert found.fit.after.rms_percent < 0.2 * found.fit.before.rms_percent
    assert "equally possible" in (tmp_path / "out" / "report.html").read_text()
