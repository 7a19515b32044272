"""Whole diagnoses of the flying wing from FRFs of a roving accelerometer: two fins left out, and nothing left out."""

from pathlib import Path

import numpy as np
import pytest
from body_studies import holds

from concealed_wings import FINS, diagnosed_wing
from statorhom.results.diagnosis import Diagnosis, PlanLocation

pytestmark = pytest.mark.slow
FAR_MM = 40.0  # a fiftieth of the span


@pytest.fixture(scope="module")
def finned(tmp_path_factory: pytest.TempPathFactory) -> Diagnosis:
    return diagnosed_wing(tmp_path_factory.mktemp("fins"), FINS)


def test_two_fins_left_out_are_named_with_both_places(finned: Diagnosis) -> None:
    assert finned.verdict == "named"
    assert [effect.effect for effect in finned.effects] == ["attached_mass", "attached_mass"]
    [fin] = FINS
    places = []
    for effect in finned.effects:
        assert isinstance(effect.location, PlanLocation)
        places.append((effect.location.x_mm, effect.location.y_mm))
    places.sort(key=lambda place: place[1])
    true = [(1e3 * fin.x, -1e3 * fin.y), (1e3 * fin.x, 1e3 * fin.y)]
    assert np.abs(np.array(places) - true).max() < FAR_MM


def test_the_masses_are_found_and_the_error_falls(finned: Diagnosis) -> None:
    [fin] = FINS
    for effect in finned.effects:
        assert holds(effect.parameters["mass_kg"], fin.mass)
    assert finned.fit.after.rms_percent < 0.3 * finned.fit.before.rms_percent


def test_a_wing_without_fins_lacks_nothing(tmp_path: Path) -> None:
    found = diagnosed_wing(tmp_path, ())
    assert found.verdict == "none"
    assert found.effects == ()
