"""What the library offers for plates, beams and wings: nothing that needs slots, frames or a circumference."""

from pathlib import Path

import numpy as np
import pytest

from coupon_study import BEAM, PLATE, study_text, write_study
from statorhom.physics.library import all_candidates, candidates_of, library
from statorhom.physics.plan import WingPlan, plan_of
from statorhom.study.study import StudyFiles, load_study
from wing_study import write_wing

OFFERED = {"attached_mass", "local_stiffness", "suspension_stiffness", "wrong_input"}


def coupon(folder: Path, region: str, geometry: str) -> StudyFiles:
    (folder / "free.csv").write_text("frequency_hz\n100\n")
    text = study_text(region, "orthotropic", 0.4, 'modal_table = "free.csv"')
    return load_study(write_study(folder, geometry, text))


@pytest.mark.parametrize(("region", "geometry"), [("plate", PLATE), ("beam", BEAM)])
def test_coupons_are_offered_what_they_can_have(tmp_path: Path, region: str, geometry: str) -> None:
    files = coupon(tmp_path, region, geometry)
    candidates = all_candidates(files)
    assert {c.effect for c in candidates} == OFFERED
    inputs = {c.chosen["input"] for c in candidates if c.effect == "wrong_input"}
    height = "thickness_mm" if region == "plate" else "height_mm"
    assert inputs == {"mass_kg", "length_mm", "width_mm", height}


def test_a_wing_is_offered_its_weight_but_no_dimension(tmp_path: Path) -> None:
    files = load_study(write_wing(tmp_path))
    candidates = all_candidates(files)
    assert {c.effect for c in candidates} == OFFERED
    assert [c.chosen["input"] for c in candidates if c.effect == "wrong_input"] == ["mass_kg"]


def test_a_lump_acts_where_its_parameters_say(tmp_path: Path) -> None:
    files = coupon(tmp_path, "plate", PLATE)
    lump, _ = [c for c in all_candidates(files) if c.effect == "attached_mass"]
    assert lump.repeats
    values = {"mass_kg": 0.01, "x_m": 0.1, "y_m": 0.05}
    [attached] = library()["attached_mass"].action(lump, values, files).attachments
    assert attached.place == (0.1, 0.05, 0.004)
    assert attached.mass_kg == 0.01
    assert attached.stiffness == (0.0, 0.0, 0.0)


def test_two_lumps_on_both_sides_are_one_candidate_that_no_study_declares(tmp_path: Path) -> None:
    files = coupon(tmp_path, "plate", PLATE)
    [pair] = [c for c in all_candidates(files) if c.both_sides]
    assert pair not in candidates_of(library()["attached_mass"], files)
    values = {"mass_kg": 0.01, "x_m": 0.1, "y_m": 0.05}
    right, left = library()["attached_mass"].action(pair, values, files).attachments
    assert (right.mass_kg, left.mass_kg) == (0.01, 0.01)
    assert right.place == (0.1, 0.05, 0.004)
    assert left.place == pytest.approx((0.2, 0.05, 0.004))


def test_a_suspension_holds_both_sides_with_half_each(tmp_path: Path) -> None:
    files = coupon(tmp_path, "plate", PLATE)
    [springs] = [c for c in all_candidates(files) if c.effect == "suspension_stiffness"]
    values = {"stiffness_n_per_m": 1e4, "x_m": 0.1, "y_m": 0.05}
    action = library()["suspension_stiffness"].action(springs, values, files)
    assert [a.place[0] for a in action.attachments] == pytest.approx([0.1, 0.2])
    assert sum(a.stiffness[2] for a in action.attachments) == 1e4
    assert action.touches("plate", "free")
    assert not action.touches("plate", "another")


def test_a_place_on_a_wing_lies_on_it(tmp_path: Path) -> None:
    plan = plan_of(load_study(write_wing(tmp_path)))
    assert isinstance(plan, WingPlan)
    tip = plan.on_top({"chord_share": 1.0, "y_m": -0.4})
    assert tip[0] == pytest.approx(0.4 * np.tan(np.radians(10.0)) + 0.2)
    right, left = plan.both_sides({"chord_share": 0.5, "y_m": 0.2})
    assert left[:2] == (right[0], -right[1])
    assert max(x for x, _ in plan.outline) == pytest.approx(max(tip[0], 0.3))


def test_a_patch_is_as_wide_as_it_says_and_usual_where_it_does_not(tmp_path: Path) -> None:
    files = coupon(tmp_path, "plate", PLATE)
    [patch] = [c for c in all_candidates(files) if c.effect == "local_stiffness"]
    radius = patch.parameters[-1]
    mean = 1e3 * np.sqrt(0.3 * 0.2)
    assert (radius.name, radius.usual) == ("radius_mm", pytest.approx(0.12 * mean))
    values = {"stiffness_ratio": 0.5, "x_m": 0.1, "y_m": 0.05, "radius_mm": 15.0}
    [softer] = library()["local_stiffness"].action(patch, values, files).patches
    assert (softer.centre, softer.radius, softer.ratio) == ((0.1, 0.05), pytest.approx(0.015), 0.5)
    assert library()["local_stiffness"].reported(patch, values) == {"stiffness_ratio": 0.5, "radius_mm": 15.0}
