"""Two of one effect on both sides of a body, told one by one."""

from __future__ import annotations

from pathlib import Path

import pytest

from coupon_study import PLATE, study_text, write_study
from statorhom.diagnose.located.sides import one_by_one, opposite_location
from statorhom.physics.library import all_candidates, library
from statorhom.results.diagnosis import PlanLocation
from statorhom.study.study import StudyFiles, load_study
from wing_study import write_wing


@pytest.fixture
def plate(tmp_path: Path) -> StudyFiles:
    (tmp_path / "free.csv").write_text("frequency_hz\n100\n")
    text = study_text("plate", "orthotropic", 0.4, 'modal_table = "free.csv"')
    return load_study(write_study(tmp_path, PLATE, text))


def test_a_pair_is_two_that_do_the_same(plate: StudyFiles) -> None:
    [pair] = [c for c in all_candidates(plate) if c.both_sides]
    values = {"mass_kg": 0.01, "x_m": 0.1, "y_m": 0.05}
    act = library()["attached_mass"].action
    alone = [act(c, v, plate) for c, v in one_by_one(pair, values, plate)]
    assert [len(action.attachments) for action in alone] == [1, 1]
    assert tuple(a for action in alone for a in action.attachments) == act(pair, values, plate).attachments


def test_what_is_alone_stays_alone(plate: StudyFiles) -> None:
    one = next(c for c in all_candidates(plate) if c.effect == "attached_mass" and not c.both_sides)
    values = {"mass_kg": 0.01, "x_m": 0.1, "y_m": 0.05}
    assert one_by_one(one, values, plate) == [(one, values)]


def test_the_other_end_of_a_plate(plate: StudyFiles) -> None:
    place = PlanLocation(x_mm=80.0, x_sd_mm=1.0, y_mm=30.0, y_sd_mm=2.0, place_ambiguity_mm=((80.0, 170.0),))
    other = opposite_location(place, plate)
    assert isinstance(other, PlanLocation)
    assert (other.x_mm, other.y_mm) == pytest.approx((220.0, 30.0))
    [alike] = other.place_ambiguity_mm
    assert alike == pytest.approx((220.0, 170.0))


def test_the_other_side_of_a_wing_is_left(tmp_path: Path) -> None:
    place = PlanLocation(x_mm=80.0, x_sd_mm=1.0, y_mm=300.0, y_sd_mm=2.0)
    other = opposite_location(place, load_study(write_wing(tmp_path)))
    assert isinstance(other, PlanLocation)
    assert (other.x_mm, other.y_mm, other.x_sd_mm, other.y_sd_mm) == (80.0, -300.0, 1.0, 2.0)
