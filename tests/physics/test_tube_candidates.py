"""What the library offers for tubes: what a ring can have without sheets, windings, frames and supports."""

from pathlib import Path

import pytest

from concealed_tubes import TYPED, write_tube
from statorhom.physics.library import all_candidates, candidates_of, library
from statorhom.physics.ring import ring_of
from statorhom.study.regions import core_region
from statorhom.study.study import StudyFiles, load_study

OFFERED = {
    "attached_mass",
    "local_stiffness",
    "mislabelled_mode",
    "ovality",
    "suspension_stiffness",
    "wrong_input",
}


def tube(folder: Path, test: str = 'modal_table = "free.csv"', symmetry: str = "isotropic") -> StudyFiles:
    (folder / "free.csv").write_text("frequency_hz,order,axial\n1758,2,0\n")
    (folder / "free.uff").write_text("")
    return load_study(write_tube(folder, test, mass_kg=1.67, symmetry=symmetry))


@pytest.mark.parametrize("symmetry", ["isotropic", "transversely_isotropic", "orthotropic"])
def test_a_tube_is_offered_what_its_wall_can_have(tmp_path: Path, symmetry: str) -> None:
    candidates = all_candidates(tube(tmp_path, symmetry=symmetry))
    assert {c.effect for c in candidates} == OFFERED
    assert {c.region for c in candidates} <= {"tube", None}
    inputs = {c.chosen["input"] for c in candidates if c.effect == "wrong_input"}
    assert inputs == {"mass_kg", "outer_diameter_mm", "inner_diameter_mm", "length_mm"}


def test_a_recorded_tube_may_have_carried_a_sensor(tmp_path: Path) -> None:
    candidates = all_candidates(tube(tmp_path, 'frf = "free.uff"'))
    assert {c.effect for c in candidates} == OFFERED - {"mislabelled_mode"} | {"sensor_mass"}


def test_no_diameter_leaves_a_tube_without_a_wall(tmp_path: Path) -> None:
    ends = {
        c.chosen["input"]: c.parameters[0] for c in candidates_of(library()["wrong_input"], tube(tmp_path))
    }
    outer, inner = ends["outer_diameter_mm"], ends["inner_diameter_mm"]
    assert outer.lower > TYPED.inner_diameter_mm
    assert 0 < inner.lower < inner.upper < TYPED.outer_diameter_mm
    for size in (outer, inner):
        assert size.lower < size.low90 < min(size.starts) < max(size.starts) < size.high90 < size.upper
        assert size.absent is not None and min(size.starts) < size.absent < max(size.starts)


def test_the_wall_is_the_core_of_a_ring_without_slots(tmp_path: Path) -> None:
    ring = ring_of(tube(tmp_path))
    assert (ring.region, ring.slots) == ("tube", 0)
    assert (ring.length, ring.outer_radius, ring.yoke) == pytest.approx((0.12, 0.05, 0.006))
    assert ring.slot_radius == pytest.approx(0.044)


def test_effects_of_tubes_are_told_in_words_of_tubes(tmp_path: Path) -> None:
    files = tube(tmp_path)
    for name in OFFERED:
        words = library()[name].words(files)
        said = " ".join([words.summary, words.note or ""])
        assert not {"core", "yoke", "stack"} & set(said.replace(",", " ").split())
        assert {c.effect for c in words.confused_with} <= OFFERED | {"interlaminar_shear"}


def test_a_ring_has_one_core() -> None:
    assert core_region(("winding", "lamination", "frame")) == "lamination"
    assert core_region(["tube"]) == "tube"
    with pytest.raises(ValueError, match="one region of lamination, tube"):
        core_region(("plate",))
